// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include "common/clock.hpp"

namespace telehug {

// A contact bounces when it closes and opens: a new level counts once it has been stable for `settle`. Times never go
// back; one that does is taken for the last one.
class Debouncer {
 public:
  Debouncer(Duration settle, bool active) noexcept : settle_(settle), active_(active), raw_(active) {}

  // The level that the contact has from `time` on, until it is told otherwise.
  void level(bool active, Timestamp time) noexcept {
    time = advance(time);
    if (active == raw_) return;
    raw_ = active;
    changed_ = time;
    if (!restless_since_) restless_since_ = time;
    (void)advance(time);  // for a settle of 0
  }

  // Lets a level settle that has been stable for long enough at `time`.
  Timestamp advance(Timestamp time) noexcept {
    now_ = std::max(now_, time);
    if (restless_since_ && now_ - changed_ >= settle_) {
      active_ = raw_;
      restless_since_.reset();
    }
    return now_;
  }

  // The level that counts.
  [[nodiscard]] bool active() const noexcept { return active_; }
  // Since when it has been bouncing; nothing while all is quiet.
  [[nodiscard]] std::optional<Timestamp> restless_since() const noexcept { return restless_since_; }
  // When a level settles unless it changes before.
  [[nodiscard]] std::optional<Timestamp> due() const noexcept {
    if (!restless_since_) return std::nullopt;
    return changed_ + settle_;
  }

 private:
  Duration settle_;
  bool active_;
  bool raw_;
  Timestamp now_ = Timestamp::min();
  Timestamp changed_ = Timestamp::min();
  std::optional<Timestamp> restless_since_;
};

}  // namespace telehug
