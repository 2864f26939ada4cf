// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "calibration/touch_model.hpp"
#include "common/units.hpp"
#include "finger/finger.hpp"
#include "touch/finger_observation.hpp"

namespace telehug {

// A point this far outside the screen is still taken for a touch of its edge, with an inexact model.
inline constexpr double outside_limit_mm = 20;

// A hovering finger is seen below the screen's bottom edge; this far outside there is none.
inline constexpr double hovering_limit_mm = 120;

struct TouchedPoints {
  FingerObservations fingers;
  std::size_t dropped = 0;  // fingers that the model places nowhere or too far outside the screen
};

// Where fingers touch the screen, or seem to, in the order of `fingers`. `image` is the size of the pictures they were
// found in. Fingers of which nothing is known but their tip must be near the screen.
[[nodiscard]] TouchedPoints screen_points(const Fingers& fingers, const TouchModel& model, const ScreenSize& screen,
                                          ImageSize image);

[[nodiscard]] bool near_screen(const ScreenPoint& point, const ScreenSize& screen, double limit_mm = outside_limit_mm);

// The signed column of the thesis: from the image centre, positive to the right.
[[nodiscard]] constexpr double column_from_centre_px(double u_px, ImageSize image) noexcept {
  return u_px - 0.5 * (image.width_px - 1);
}

}  // namespace telehug
