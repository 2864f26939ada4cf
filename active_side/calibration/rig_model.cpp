// SPDX-License-Identifier: Apache-2.0
#include "calibration/rig_model.hpp"

#include <cmath>

namespace telehug {

std::optional<ScreenPoint> contact_point(const RigCamera& camera, double contact_radius_mm,
                                         const ImagePoint& tip) noexcept {
  const auto direction = camera.ray(tip);
  const auto met = camera.screen_point(tip);
  if (!direction || !met || !(direction->y_mm > 0)) return std::nullopt;
  const double a = std::atan2(-direction->z_mm, direction->y_mm);
  const double tangent_mm = contact_radius_mm * std::tan(a / 2);
  // The ray touches the ball `tangent_mm` before it meets the screen, and as far beside the camera as the contact is.
  const double back_mm = tangent_mm * std::cos(a);
  return ScreenPoint{met->x_mm - back_mm * direction->x_mm / direction->y_mm, met->y_mm + tangent_mm};
}

std::optional<ImagePoint> tip_of_contact(const RigCamera& camera, double contact_radius_mm,
                                         const ScreenPoint& contact) noexcept {
  // In the plane x = contact.x_mm, from the camera's foot: the ball's centre, and the tangent below it.
  const double y = contact.y_mm - camera.position_mm().y_mm;
  const double below = camera.position_mm().z_mm - contact_radius_mm;
  const double distance = std::hypot(y, below);
  if (!(y > 0) || !(distance > std::abs(contact_radius_mm))) return std::nullopt;
  const double a = std::atan2(below, y) + std::asin(contact_radius_mm / distance);
  const double tangent = std::sqrt(distance * distance - contact_radius_mm * contact_radius_mm);
  return camera.project(RigVector{contact.x_mm, camera.position_mm().y_mm + tangent * std::cos(a),
                                  camera.position_mm().z_mm - tangent * std::sin(a)});
}

}  // namespace telehug
