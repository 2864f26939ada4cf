// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "capture/virtual_rig/hand_looks.hpp"
#include "common/units.hpp"

namespace telehug {

// Where the foremost point of a finger is: over or on a point of the screen.
struct FingerPlace {
  ScreenPoint foot;     // straight below it on the screen; while it touches, the middle of the contact patch
  double hover_mm = 0;  // 0: it touches
};

// What a hand does: one that does not point is placed by its foremost point as if that were a finger's.
enum class Posture { pointing, fist, forearm };

// A hand that points at the screen. Its index finger, and the middle finger if `second` is given, is straight or bent a
// little; the others are curled.
struct HandPose {
  FingerPlace finger;
  Posture posture = Posture::pointing;
  std::optional<FingerPlace> second;  // 15 to 60 mm beside the first, else the hand is torn
  double approach_deg = 57;           // between the finger's end and the screen: 20 flat, 70 steep
  double lean_deg = 8;    // the finger leans to the thumb's side (> 0: the hand is beside it, away from the thumb)
  double turn_deg = 0;    // about the finger's axis; the nail turns away from the thumb
  double bend_deg = 8;    // of each joint
  double press_mm = 0.2;  // how far a touching finger is pressed flat; a patch 3.5 mm across
  cv::Vec3d velocity_mm_per_s{0, 0, 0};  // of the whole hand, in the rig frame; blurs it while the shutter is open
  std::optional<HandLooks> looks;        // nullopt: those of the rig's settings
};

}  // namespace telehug
