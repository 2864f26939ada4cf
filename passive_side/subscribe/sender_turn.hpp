// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "common/clock.hpp"
#include "subscribe/sender_number.hpp"

namespace telehug {

// Whose touches are felt when several senders touch one jacket.
class SenderTurn {
 public:
  // Whoever touched last keeps the turn for so long.
  static constexpr Duration pause = 2s;

  // one_at_a_time: false: everybody's.
  explicit SenderTurn(bool one_at_a_time) : one_at_a_time_(one_at_a_time) {}

  // May this sender be felt now? `touches`: its newest event holds a contact, or a tap that is over. One thread asks,
  // with times that do not go back.
  bool take(SenderNumber sender, bool touches, Timestamp now) {
    if (!one_at_a_time_) return true;
    const bool taken = holder_ && *holder_ != sender && now - touched_ < pause;
    if (taken) return false;
    if (touches) {
      holder_ = sender;
      touched_ = now;
    }
    return true;
  }

 private:
  bool one_at_a_time_;
  std::optional<SenderNumber> holder_;
  Timestamp touched_;
};

}  // namespace telehug
