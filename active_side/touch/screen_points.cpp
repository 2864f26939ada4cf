// SPDX-License-Identifier: Apache-2.0
#include "touch/screen_points.hpp"

namespace telehug {
namespace {

std::optional<ScreenPoint> touched_point(const Finger& finger, const TouchModel& model, ImageSize image) {
  if (const auto* rig = std::get_if<RigModel>(&model)) {
    return finger.contact ? rig->camera.screen_point(*finger.contact) : rig->screen_point(finger.tip);
  }
  return std::get_if<ThesisTouchModel>(&model)->screen_point(finger.length_px,
                                                             column_from_centre_px(finger.tip.u_px, image));
}

}  // namespace

bool near_screen(const ScreenPoint& point, const ScreenSize& screen, double limit_mm) {
  return point.x_mm >= -limit_mm && point.x_mm <= screen.width_mm + limit_mm && point.y_mm >= -limit_mm &&
         point.y_mm <= screen.height_mm + limit_mm;
}

TouchedPoints screen_points(const Fingers& fingers, const TouchModel& model, const ScreenSize& screen,
                            ImageSize image) {
  TouchedPoints touched;
  for (const Finger& finger : fingers) {
    const auto point = touched_point(finger, model, image);
    const bool may_hover = finger.px_per_mm > 0;
    if (point && near_screen(*point, screen, may_hover ? hovering_limit_mm : outside_limit_mm)) {
      const double width_mm = may_hover ? finger.width_px / finger.px_per_mm : 0;
      touched.fingers.push_back({*point, width_mm, finger.px_per_mm, finger.mirror, 1});
    } else {
      ++touched.dropped;
    }
  }
  return touched;
}

}  // namespace telehug
