// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "peer/session_succession.hpp"

namespace telehug {

inline constexpr Duration peer_timeout = 250ms;  // two heartbeats may be lost

// Is the peer's pipeline alive? It is while heartbeats of its present session come in, each newer than the one before:
// DDS' own liveliness can't say so when the peer's program hangs. Not for use by several threads at a time.
class PeerMonitor {
 public:
  explicit PeerMonitor(Duration timeout = peer_timeout) : timeout_(timeout) {}

  // False: not counted as a sign of life (of a replaced session, a duplicate, or overtaken by a newer one).
  bool heard(const Heartbeat& peer, Timestamp now);

  // Ask often (at least once a time-out): this is what notices a loss.
  bool alive(Timestamp now) noexcept;

  // Of the peer's present or last session; empty before the first heartbeat.
  [[nodiscard]] const SessionId& session() const noexcept { return sessions_.current(); }

  // How often a peer that was alive fell silent.
  [[nodiscard]] std::uint64_t losses() const noexcept { return losses_; }
  // How often heard() said false.
  [[nodiscard]] std::uint64_t ignored() const noexcept { return ignored_; }

 private:
  Duration timeout_;
  SessionSuccession sessions_;
  std::uint64_t last_sequence_ = 0;
  Timestamp last_heard_;
  bool alive_ = false;
  std::uint64_t losses_ = 0;
  std::uint64_t ignored_ = 0;
};

}  // namespace telehug
