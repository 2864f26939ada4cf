// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace telehug {

enum class DisturbanceKind {
  lights,        // the room's light is `amount` times as strong
  screen_flash,  // the screen is white
  bump,          // the camera is turned by `amount` degrees: pitch, and half of it roll
  black_frames,  // pictures are black
  torn_frames,   // the lower part of a picture, from `amount` (0 to 1) of its height on, is that of the one before
  frozen,        // the picture does not change
};

// Something that goes wrong from begin_s until before end_s of the script.
struct Disturbance {
  DisturbanceKind kind = DisturbanceKind::lights;
  double begin_s = 0;
  double end_s = 0;
  double amount = 0;
};

}  // namespace telehug
