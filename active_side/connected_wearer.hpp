// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/lockfree/spsc_queue.hpp>
#include <string>
#include <utility>

#include "daemon/connection.hpp"
#include "daemon/renewal_link.hpp"
#include "peer_link/hug_inbox.hpp"

namespace telehug {

// What goes between the two beside touches and answers.
class BesideTouches {
 public:
  BesideTouches(const std::optional<Pair>& pair, const SessionId&, const Clock& clock) : renewal_(pair), hugs_(clock) {}
  void connect(DdsParticipant& participant) {
    renewal_.connect(participant);
    hugs_.connect(participant);
  }
  void disconnect() {
    hugs_.disconnect();
    renewal_.disconnect();
  }
  void serve(WallTime now) { renewal_.serve(now); }
  [[nodiscard]] std::uint64_t dropped() const { return renewal_.dropped() + hugs_.dropped(); }
  [[nodiscard]] HugInbox& hugs() noexcept { return hugs_; }

 private:
  RenewalReceiver renewal_;
  HugInbox hugs_;
};

// One of those whom this PC touches: the connection to them, and what they answer.
class ConnectedWearer {
 public:
  ConnectedWearer(Membership membership, const SessionId& session, Duration heartbeat_timeout, const Clock& clock)
      : connection(std::move(membership), session, heartbeat_timeout, clock,
                   [this](const Felt& answer) { felt.push(answer); }) {}
  // The queue's own destructor (Boost 1.74) does not destroy what it holds.
  ~ConnectedWearer() {
    felt.consume_all([](const Felt&) {});
  }
  ConnectedWearer(const ConnectedWearer&) = delete;
  ConnectedWearer& operator=(const ConnectedWearer&) = delete;

  [[nodiscard]] const Membership& membership() const noexcept { return connection.membership(); }
  [[nodiscard]] std::string name() const { return connection.name(); }
  // Touch thread: may be touched now.
  [[nodiscard]] bool listens(Timestamp now) { return connection.alive(now) && !connection.stopped_by_peer(); }

  boost::lockfree::spsc_queue<Felt, boost::lockfree::capacity<1024>> felt;  // from a thread of DDS to housekeeping
  Connection<TouchEvent, Felt, BesideTouches> connection;  // last: it calls back as soon as it is there
};

}  // namespace telehug
