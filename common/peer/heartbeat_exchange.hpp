// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "peer/path_delay.hpp"

namespace telehug {

inline constexpr Duration heartbeat_interval = 100ms;

// The heartbeats that one side sends, and what the peer's answers say about the way there and back. Both sides run one.
// Not for use by several threads at a time.
class HeartbeatExchange {
 public:
  // session: as made by new_session_id().
  HeartbeatExchange(SessionId session, Side side);

  // When the next heartbeat is to be sent (at once, after construction).
  [[nodiscard]] Timestamp next_due() const noexcept { return next_due_; }

  // The heartbeat to send now; call when next_due() has come. Valid until the next call. Beats that were missed (a
  // stalled program) are left out, not made up for.
  const Heartbeat& beat(Timestamp now);

  // A heartbeat that PeerMonitor accepted.
  void heard(const Heartbeat& peer, Timestamp now);

  // Time from here to the peer and back, without the time that the peer held the stamp: of the newest answer, and
  // smoothed. Empty before the first answer of the peer's present session.
  [[nodiscard]] std::optional<Duration> round_trip() const noexcept { return newest_; }
  [[nodiscard]] std::optional<Duration> smoothed_round_trip() const noexcept { return smoothed_; }
  // How long the peer's newest heartbeat was on its way: half the session's smallest round trip, and what it was late
  // above the smallest delay of the last seconds. Without synchronised clocks that is as near as one can get: a way
  // that is longer than the way back by d is estimated d/2 too short.
  [[nodiscard]] std::optional<Duration> one_way() const noexcept;

 private:
  Heartbeat own_;
  Timestamp next_due_{};
  Timestamp peer_heard_{};
  std::optional<Duration> newest_;
  std::optional<Duration> smoothed_;
  std::optional<Duration> smallest_;
  PathDelay path_;
  Duration late_{};
};

}  // namespace telehug
