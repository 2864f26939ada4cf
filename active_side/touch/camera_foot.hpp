// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibration/rig_camera.hpp"
#include "common/units.hpp"

namespace telehug {

// What of the rig's geometry turns a change of height into a motion on the screen: where the camera stands.
struct CameraFoot {
  ScreenPoint foot;               // the camera's place projected onto the screen's plane
  double height_mm = 45;          // of the camera above that plane, > 0
  double screen_bottom_mm = 300;  // y of the border that a finger must cross to be seen
};

[[nodiscard]] inline CameraFoot camera_foot(const RigCamera& camera, const ScreenSize& screen) noexcept {
  const RigVector& at = camera.position_mm();
  return {{at.x_mm, at.y_mm}, at.z_mm, screen.height_mm};
}

}  // namespace telehug
