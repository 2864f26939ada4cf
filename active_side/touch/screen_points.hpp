// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "calibration/touch_model.hpp"
#include "common/units.hpp"
#include "finger/finger.hpp"
#include "touch/contact_state.hpp"

namespace telehug {

// A point this far outside the screen is still taken for a touch of its edge, with an inexact model.
inline constexpr double outside_limit_mm = 20;

struct TouchedPoints {
  ScreenPoints points;
  std::size_t dropped = 0;  // fingers that the model places nowhere or too far outside the screen
};

// Where fingers touch the screen, in the order of `fingers`. `image` is the size of the pictures they were found in.
[[nodiscard]] TouchedPoints screen_points(const Fingers& fingers, const TouchModel& model, const ScreenSize& screen,
                                          ImageSize image);

// The signed column of the thesis: from the image centre, positive to the right.
[[nodiscard]] constexpr double column_from_centre_px(double u_px, ImageSize image) noexcept {
  return u_px - 0.5 * (image.width_px - 1);
}

}  // namespace telehug
