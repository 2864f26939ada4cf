// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "capture/virtual_rig/distance_grid.hpp"
#include "capture/virtual_rig/hand_pose.hpp"

namespace telehug {

// A hand in a pose, as a mesh and as the limbs that it is made from, around the middle of the ball at the end of its
// index finger. Moving it to another place of the screen needs no new shape.
struct HandShape {
  TriangleMesh mesh;
  std::vector<Limb> limbs;
  cv::Vec3f lowest_mm;      // the foremost point of the index finger, nail included
  cv::Vec3f contact_mm;     // middle of what is pressed flat when it touches, on the plane that presses it
  bool nail_first = false;  // the nail arrives at the screen before the skin

  // Where the ball's middle is when the index finger is there.
  [[nodiscard]] cv::Vec3f place_for(const FingerPlace& finger) const;
};

HandShape hand_shape(const HandPose& pose, const HandLooks& looks);

}  // namespace telehug
