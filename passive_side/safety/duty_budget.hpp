// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/clock.hpp"

namespace telehug {

// How long a motor may run within a window that slides, so that it stays cool. Memory is bounded: the window is counted
// in parts, and what was run in a part counts until the whole of it has left the window.
//
// What counts is strength x time. Through the winding of a coin motor flows (supply - back EMF) / R while the pin is
// high; as its L / R (tens of us) is short against the firmware's PWM period of 1 ms, that current is there for the
// share `strength` of the time, and so is its heat I^2 R. Were the PWM so fast that the winding smoothed the current
// (Precision Microdrives, AB-012), the heat would grow with the square of strength, which is less: strength x time is
// the bound for both.
class DutyBudget {
 public:
  // max_duty: above 0; from 1 on nothing is limited. window: above 0.
  DutyBudget(double max_duty, Duration window) noexcept;

  // The motor has run at `strength` (0..1 of what its profile allows) for `time` up to now.
  void run(double strength, Duration time, Timestamp now) noexcept;

  // The strongest that a command of at most 250 ms may be now, 0..1. All of it until a fifth of the budget is left;
  // then what is left shrinks more and more slowly, so that a touch that lasts fades instead of breaking off.
  [[nodiscard]] double most(Timestamp now) noexcept;
  // The share of the budget that is used up now; 0 if nothing is limited.
  [[nodiscard]] double used(Timestamp now) noexcept;

 private:
  static constexpr std::size_t parts = 64;

  [[nodiscard]] double used_s() const noexcept;
  void slide(Timestamp now) noexcept;

  bool limited_;
  double budget_s_;  // seconds at strength 1
  Duration part_;
  std::array<double, parts + 1> used_s_{};  // the present part, and those of a whole window before
  std::size_t present_ = 0;
  std::int64_t present_number_ = 0;  // of the part, since the clock's epoch
};

}  // namespace telehug
