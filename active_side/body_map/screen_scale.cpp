// SPDX-License-Identifier: Apache-2.0
#include "body_map/screen_scale.hpp"

#include <fmt/format.h>

#include <cmath>

namespace telehug {

ScreenPoint ScreenScale::to_mm(const cv::Point2d& px) const {
  return {.x_mm = px.x * mm_per_px_x, .y_mm = px.y * mm_per_px_y};
}

ScreenRect ScreenScale::to_mm(const cv::Rect2d& px) const {
  return {.x_mm = px.x * mm_per_px_x,
          .y_mm = px.y * mm_per_px_y,
          .width_mm = px.width * mm_per_px_x,
          .height_mm = px.height * mm_per_px_y};
}

cv::Rect2d ScreenScale::to_px(const ScreenRect& mm) const {
  return {mm.x_mm / mm_per_px_x, mm.y_mm / mm_per_px_y, mm.width_mm / mm_per_px_x, mm.height_mm / mm_per_px_y};
}

Result<ScreenScale> make_screen_scale(const ScreenSize& screen, ImageSize desktop) {
  if (desktop.width_px == 0 && desktop.height_px == 0) {
    desktop = {.width_px = screen.width_px, .height_px = screen.height_px};
  }
  if (desktop.width_px <= 0 || desktop.height_px <= 0) {
    return Error{fmt::format("The desktop is {}x{} px; both must be above 0.", desktop.width_px, desktop.height_px)};
  }
  const ScreenScale scale{.mm_per_px_x = screen.width_mm / desktop.width_px,
                          .mm_per_px_y = screen.height_mm / desktop.height_px};
  if (!(scale.mm_per_px_x > 0) || !(scale.mm_per_px_y > 0) || !std::isfinite(scale.mm_per_px_x) ||
      !std::isfinite(scale.mm_per_px_y)) {
    return Error{fmt::format("The screen is {}x{} mm; measure its visible picture and set width and height in mm.",
                             screen.width_mm, screen.height_mm)};
  }
  return scale;
}

}  // namespace telehug
