// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "common/clock.hpp"
#include "common/latest_slot.hpp"
#include "peer/heard_hugs.hpp"
#include "peer_link/one_way.hpp"
#include "peer_link/peer_link.hpp"

namespace telehug {

// A hug of the wearer, and when it came.
struct ShownHug {
  double strength = 0;
  Timestamp time;
};

// The wearer's hugs as one peer's arrive, while the participant under them may be replaced.
class HugInbox {
 public:
  explicit HugInbox(const Clock& clock)  // outlives it
      : incoming_([this, &clock](const Hug& hug) {
          slot_.put({hug, clock.now()});
        }) {}

  // --- pipeline's thread, which must not wait ---

  // What PeerLink::serve() has heard.
  void observe(const HeardHeartbeat& heard) { heard_.observe(heard.heartbeat, heard.time); }

  // The newest, if one has come that is to be shown (HeardHugs).
  std::optional<ShownHug> take() {
    const auto arrived = slot_.try_take();
    if (!arrived) return std::nullopt;
    ++received_;
    if (heard_.shows(arrived->hug, arrived->time)) return ShownHug{arrived->hug.strength, arrived->time};
    ++not_shown_;
    return std::nullopt;
  }

  // --- housekeeping thread ---

  void disconnect() { incoming_.disconnect(); }
  void connect(DdsParticipant& participant) { incoming_.connect(participant); }  // throws as Incoming does

  // --- any thread ---

  [[nodiscard]] std::uint64_t received() const noexcept { return received_; }
  [[nodiscard]] std::uint64_t not_shown() const noexcept { return not_shown_; }
  [[nodiscard]] std::uint64_t dropped() const { return incoming_.dropped(); }

 private:
  struct Arrived {
    Hug hug;
    Timestamp time;
  };

  HeardHugs heard_;
  std::atomic<std::uint64_t> received_ = 0;
  std::atomic<std::uint64_t> not_shown_ = 0;
  LatestSlot<Arrived> slot_;
  Incoming<Hug> incoming_;
};

}  // namespace telehug
