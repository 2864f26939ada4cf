// SPDX-License-Identifier: Apache-2.0
#include "peer/peer_monitor.hpp"

namespace telehug {

bool PeerMonitor::heard(const Heartbeat& peer, Timestamp now) {
  alive(now);  // a silence that ends with this heartbeat was a loss
  const auto standing = sessions_.admit(peer.session);
  const bool overtaken = standing == SessionSuccession::Standing::current && peer.sequence <= last_sequence_;
  if (standing == SessionSuccession::Standing::retired || overtaken) {
    ++ignored_;
    return false;
  }
  last_sequence_ = peer.sequence;
  last_heard_ = now;
  alive_ = true;
  return true;
}

bool PeerMonitor::alive(Timestamp now) noexcept {
  if (alive_ && now - last_heard_ > timeout_) {
    alive_ = false;
    ++losses_;
  }
  return alive_;
}

}  // namespace telehug
