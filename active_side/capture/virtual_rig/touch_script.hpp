// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "capture/virtual_rig/hand_pose.hpp"
#include "common/units.hpp"

namespace telehug {

// One touch: the finger is on the screen from begin_s to end_s and moves from `from` to `to` meanwhile. It comes and
// goes within approach_s before and after.
struct ScriptedTouch {
  double begin_s = 0;
  double end_s = 0;
  ScreenPoint from;
  ScreenPoint to;
  HandPose pose = {};  // but for its places
  std::optional<ScreenPoint> beside =
      std::nullopt;  // the middle finger touches, too, at the first one's place plus this
};

// Touches in order of time, at least 2 * approach_s apart, and the length of the whole.
struct TouchScript {
  std::vector<ScriptedTouch> touches;
  double length_s = 0;
};

inline constexpr double approach_s = 0.3;
inline constexpr double approach_from_mm = 180;

// nullopt: nobody is there.
std::optional<FingerPlace> finger_at(const TouchScript& script, double time_s);

// The same as a hand in its pose, or none.
std::vector<HandPose> hands_at(const TouchScript& script, double time_s);

// Taps, a long touch and a stroke in the part of the screen that a webcam above it sees well.
TouchScript default_script(const ScreenSize& screen);

// `count` taps and strokes in that part; the same for the same seed.
TouchScript random_script(const ScreenSize& screen, int count, std::uint64_t seed);

}  // namespace telehug
