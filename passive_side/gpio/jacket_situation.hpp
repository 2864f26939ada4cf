// SPDX-License-Identifier: Apache-2.0
//
// How the jacket is, as far as lines tell it to the world: values to values.
#pragma once

#include "common/clock.hpp"

namespace telehug {

struct JacketSituation {
  bool armed = false;    // the jacket answers
  bool stopped = false;  // by whomever
  bool sender = false;   // somebody who may touch is connected
  bool touched = false;  // a motor runs, or a heater warms
  bool problem = false;  // of a line, such as a lost one
};

// Do the motors get their supply? Only while somebody could be felt.
[[nodiscard]] constexpr bool supply_wanted(const JacketSituation& now) noexcept {
  return now.armed && now.sender && !now.stopped && !now.problem;
}

// The status light; dark: telehug-passive does not run.
enum class LightPattern {
  fast_blink,    // stopped, or something is wrong: 5 times a second
  double_blink,  // touched now: two short flashes a second
  slow_blink,    // waits for the other side: a flash every 2 s
  steady,        // ready
};

[[nodiscard]] LightPattern light_pattern(const JacketSituation& now) noexcept;
// Is the light on? time: since any fixed moment, not negative.
[[nodiscard]] bool light_on(LightPattern pattern, Duration time) noexcept;

}  // namespace telehug
