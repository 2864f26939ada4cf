// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "common/clock.hpp"
#include "common/messages.hpp"

namespace telehug {

// The hugs with which the wearer answers: at most one a second, however often a child presses the button. One thread at
// a time.
class HugBack {
 public:
  static constexpr Duration apart = 1s;

  // session: of the passive side.
  explicit HugBack(SessionId session) { hug_.session = std::move(session); }

  // The one to send now; nothing if it is too soon after the last one.
  [[nodiscard]] std::optional<Hug> next(double strength, Timestamp now) {
    if (last_ && now - *last_ < apart) return std::nullopt;
    last_ = now;
    ++hug_.sequence;
    hug_.sent_time_ns = to_ns(now);
    hug_.strength = strength;
    return hug_;
  }

 private:
  Hug hug_;
  std::optional<Timestamp> last_;
};

}  // namespace telehug
