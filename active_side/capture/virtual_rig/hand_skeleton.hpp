// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "capture/virtual_rig/distance_grid.hpp"
#include "capture/virtual_rig/hand_pose.hpp"

namespace telehug {

// The end of a finger: where its last ball is and how it is turned.
struct FingerEnd {
  cv::Vec3f middle;  // of the ball at its end
  cv::Vec3f back;    // along the finger, away from its end
  cv::Vec3f nail;    // to the side of the nail
  cv::Vec3f side;    // to the little finger's side
  float radius_mm = 0;
  float flatness = 1;
  float nail_proud_mm = 0.35F;  // how far the nail stands above the skin
};

// A hand as limbs, around the middle of the ball at the end of its index finger.
struct HandSkeleton {
  std::vector<Limb> limbs;
  std::vector<FingerEnd> ends;       // those that are seen: index, middle finger if it points, thumb
  std::size_t pointing = 1;          // how many of `ends`, from the first, point at the screen
  std::vector<Limb> pointing_limbs;  // the visible fingers alone, one after the other, for a finer mesh
  std::vector<Limb> clothes;         // around limbs, not blended with them
  Limb ring_finger_segment;          // where a ring would sit
};

// `second_end_mm`: middle of the ball at the middle finger's end, if it points.
HandSkeleton hand_skeleton(const HandPose& pose, const HandLooks& looks, const std::optional<cv::Vec3f>& second_end_mm);

// Linear light of the skin in full light.
cv::Vec3f skin_light(int skin_tone);

}  // namespace telehug
