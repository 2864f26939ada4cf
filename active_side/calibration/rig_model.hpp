// SPDX-License-Identifier: Apache-2.0
//
// The default touch model: the rig's camera, and how far the fingertip that it sees lies from the contact.
//
// A fingertip is a rounded body; the camera sees its outline's foremost point, not the contact below it. A ray that
// grazes a ball of radius r lying on the screen meets the screen r tan(a / 2) above the contact, a being the ray's
// angle to the screen in the plane x = const (two tangents from one point are equally long). "Foremost" is the point
// farthest from the screen's bottom edge, so the grazing ray touches the ball right beside its contact (same x).
#pragma once

#include <optional>

#include "calibration/rig_camera.hpp"

namespace telehug {

// Where a finger touches whose foremost visible point is `tip`. Exact for a ball. Nothing if the camera sees no point
// of the screen's plane there.
[[nodiscard]] std::optional<ScreenPoint> contact_point(const RigCamera& camera, double contact_radius_mm,
                                                       const ImagePoint& tip) noexcept;

// Its inverse: where the camera sees the foremost point of a finger that touches `contact`.
[[nodiscard]] std::optional<ImagePoint> tip_of_contact(const RigCamera& camera, double contact_radius_mm,
                                                       const ScreenPoint& contact) noexcept;

struct RigModel {
  RigCamera camera;
  double contact_radius_mm = 0;

  [[nodiscard]] std::optional<ScreenPoint> screen_point(const ImagePoint& tip) const noexcept {
    return contact_point(camera, contact_radius_mm, tip);
  }
};

}  // namespace telehug
