// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>

#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

// Pixels of the desktop <-> screen frame (mm). Both have their origin at the top-left corner of the visible screen;
// pixel k covers k..k+1, so the desktop's far corner is the screen's far corner.
struct ScreenScale {
  double mm_per_px_x = 1;
  double mm_per_px_y = 1;

  [[nodiscard]] ScreenPoint to_mm(const cv::Point2d& px) const;
  [[nodiscard]] ScreenRect to_mm(const cv::Rect2d& px) const;
  [[nodiscard]] cv::Rect2d to_px(const ScreenRect& mm) const;
};

// The scale of a desktop of that many pixels that fills the screen. The axes are scaled apart: a recorded picture need
// not have the shape of this screen. `desktop` 0x0: the screen's own pixels. Fails if a size is not above 0.
Result<ScreenScale> make_screen_scale(const ScreenSize& screen, ImageSize desktop);

}  // namespace telehug
