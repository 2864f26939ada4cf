// SPDX-License-Identifier: Apache-2.0
//
// How strong the ways to touch are felt, as a part of the strength that the sender gives, and how that goes on with
// time. Starting points from the literature and from what coin motors can do; none is measured on people yet.
#pragma once

#include "common/clock.hpp"

namespace telehug {

// Of a touch an actuator that has less than this part is left off: it would not be felt, and costs a start. (A
// four-hundredth of the touch's energy.)
inline constexpr double least_felt = 0.05;

// A tap is one firm pulse of this length, however soon the finger is gone: a coin motor takes 50 to 100 ms to get
// going, and less is hardly felt.
inline constexpr Duration tap_pulse = 100ms;
// A pat is done with the flat hand: rounder, longer, softer.
inline constexpr Duration pat_pulse = 160ms;
inline constexpr double pat_level = 0.75;

// A motor that a stroke rushes past runs for this long ...
inline constexpr Duration burst = 100ms;
// ... and so much later than the one before it, which makes one movement of the two (apparent motion: SOA = 0.32 d +
// 47.3 ms, Israr & Poupyrev 2011).
inline constexpr Duration burst_distance =
    std::chrono::duration_cast<Duration>(0.32 * burst + std::chrono::duration<double, std::milli>(47.3));

// A hand that rests: firm at first, since that is news to the skin; then it fades, because what goes on is soon not
// noticed any more and motors want a rest; in the end a gentle pulse says that the hand is still there. In that it is
// off for more than half of the time. `rested`: how long it has been at its place. Continuous.
[[nodiscard]] double hold_level(Duration rested) noexcept;

// A hug holds longer and breathes more slowly. `held`: since it has been one.
[[nodiscard]] double hug_level(Duration held) noexcept;

// A stroke is gentle: vibration that moves is pleasant at low intensity (Huisman 2016; Israr & Abnousi 2018). Only one
// that is faster than caresses are (1 to 10 cm/s, Loken 2009) is a little firmer, since it is over each motor so soon.
// A speed that is no number counts as none.
[[nodiscard]] double stroke_level(double speed_mm_s) noexcept;

// How much of its warmth a hand has given that has been at one place for so long: nothing for seconds, then slowly all.
[[nodiscard]] double warmth(Duration rested) noexcept;

// Follows a level that jumps, so that one way to touch becomes another without a jerk.
class SteadyLevel {
 public:
  SteadyLevel(double level, Timestamp now) : level_(level), at_(now) {}

  // `now` does not go back.
  double follow(double wanted, Timestamp now) noexcept;

 private:
  double level_;
  Timestamp at_;
};

}  // namespace telehug
