// SPDX-License-Identifier: Apache-2.0
#include "touch/screen_points.hpp"

#include <algorithm>

namespace telehug {
namespace {

// Seen from above the end of a pad is curved like a circle of this radius and more; a long nail's end is pointed, and
// what is seen of it touches. (Measured on rendered hands: nails 2 to 4 mm, pads 5 to 9 mm.)
constexpr double pad_radius_mm = 6;
constexpr double nail_radius_mm = 3;

// How much of the way from the visible tip to a pad's contact applies to an end of this radius.
double pad_share(double radius_mm) {
  return std::clamp((radius_mm - nail_radius_mm) / (pad_radius_mm - nail_radius_mm), 0.0, 1.0);
}

std::optional<ScreenPoint> touched_point(const Finger& finger, const TouchModel& model, ImageSize image) {
  if (const auto* rig = std::get_if<RigModel>(&model)) {
    const bool measured = finger.tip_radius_px > 0 && finger.px_per_mm > 0;
    const double radius_mm = measured ? finger.tip_radius_px / finger.px_per_mm : pad_radius_mm;
    return contact_point(rig->camera, pad_share(radius_mm) * rig->contact_radius_mm, finger.tip);
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
