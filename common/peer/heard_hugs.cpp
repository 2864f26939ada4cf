// SPDX-License-Identifier: Apache-2.0
#include "peer/heard_hugs.hpp"

namespace telehug {

void HeardHugs::observe(const Heartbeat& peer, Timestamp now) {
  if (peer.session != session_) {
    session_ = peer.session;
    last_sequence_ = 0;
  }
  path_.observe(peer.session, peer.sent_time_ns, now);
}

bool HeardHugs::shows(const Hug& hug, Timestamp arrived) {
  // How late it is, only the heartbeats of its session tell.
  if (hug.session != session_ || hug.sequence <= last_sequence_) return false;
  last_sequence_ = hug.sequence;
  return path_.observe(hug.session, hug.sent_time_ns, arrived) <= latest;
}

}  // namespace telehug
