// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "calibration/calibration.hpp"
#include "calibration/rig_camera.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// The camera of a virtual rig.
inline RigCamera camera_of(const VirtualRigSettings& rig) {
  const RigPoint& place = rig.camera.position_mm;
  return {{rig.focal_px,
           rig.distortion_k1,
           {place[0], place[1], place[2]},
           rig.camera.pitch_deg,
           rig.camera.yaw_deg,
           rig.camera.roll_deg},
          rig.image};
}

// As if it had been calibrated without any error.
inline Calibration calibration_of(const VirtualRigSettings& rig) {
  RigSolution solution{{camera_of(rig), 5}, {}, {}, {}, {}, 0, 0};
  return {"virtual",
          "",
          rig.image,
          rig.screen,
          border_line(camera_of(rig), rig.screen),
          RigCalibration{{}, std::move(solution)}};
}

}  // namespace telehug
