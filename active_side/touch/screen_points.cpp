// SPDX-License-Identifier: Apache-2.0
#include "touch/screen_points.hpp"

namespace telehug {
namespace {

bool near_screen(const ScreenPoint& point, const ScreenSize& screen) {
  return point.x_mm >= -outside_limit_mm && point.x_mm <= screen.width_mm + outside_limit_mm &&
         point.y_mm >= -outside_limit_mm && point.y_mm <= screen.height_mm + outside_limit_mm;
}

std::optional<ScreenPoint> touched_point(const Finger& finger, const TouchModel& model, ImageSize image) {
  if (const auto* rig = std::get_if<RigModel>(&model)) return rig->screen_point(finger.tip);
  return std::get_if<ThesisTouchModel>(&model)->screen_point(finger.length_px,
                                                             column_from_centre_px(finger.tip.u_px, image));
}

}  // namespace

TouchedPoints screen_points(const Fingers& fingers, const TouchModel& model, const ScreenSize& screen,
                            ImageSize image) {
  TouchedPoints touched;
  for (const Finger& finger : fingers) {
    const auto point = touched_point(finger, model, image);
    if (point && near_screen(*point, screen)) {
      touched.points.push_back(*point);
    } else {
      ++touched.dropped;
    }
  }
  return touched;
}

}  // namespace telehug
