// SPDX-License-Identifier: Apache-2.0
//
// A camera beside the top of a screen, straight down and without distortion: exact projections for the tests of the
// touch models. A point y below the screen's top is seen K / (y - d) below the image of the camera's foot, and a point
// x beside the camera f x / (y - d) beside the image centre.
#pragma once

#include "calibration/thesis_touch_model.hpp"
#include "common/units.hpp"

namespace telehug {

struct AlignedRig {
  ScreenSize screen;
  double camera_x_mm = 0;
  double camera_below_top_mm = 0;  // d; negative: above the screen
  double vertical_scale = 0;       // K = focal length in px * distance from the screen in mm
  double horizontal_scale_px = 0;  // f; negative: mirrored, as in a picture whose right is the user's left

  [[nodiscard]] MeasuredTouch project(const ScreenPoint& point) const {
    const double below = point.y_mm - camera_below_top_mm;
    const double border_below = screen.height_mm - camera_below_top_mm;
    return {point, vertical_scale / below - vertical_scale / border_below,
            horizontal_scale_px * (point.x_mm - camera_x_mm) / below};
  }
};

}  // namespace telehug
