// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// What kind of rig it is, in words, so that errors can be told apart by them.
struct RigGroup {
  std::string bezel;  // black, silver, white, coloured
  std::string light;  // neutral, warm, cold, side, dim
  std::string coat;   // glossy, satin, matt
  std::string desk;   // plain, wood, stone
};

struct RandomRig {
  VirtualRigSettings settings;  // hand: the first user, who calibrates
  RigGroup group;
  std::vector<HandLooks> users;         // 3 people with either hand, their rings and nails
  std::vector<ScreenContent> contents;  // what the screen shows in turn; black first
  bool random_poses = true;             // the calibration's touches are as different as all others
};

// Everything drawn at random, the same for the same seed: screens 300 to 700 mm wide, cameras 25 to 80 mm in front of
// them with focal lengths of 800 to 1150 px at 1280 px, up to 30 mm beside their middle and 4 degrees askew, k1 within
// +-0.08. Always the lower border of the screen is seen, at a height of 0.35 to 0.85 of the picture.
RandomRig random_rig(std::uint64_t seed, ImageSize image = {1280, 720});

// The rig of these settings with its one user and its one screen content.
RandomRig rig_of(const VirtualRigSettings& settings);

// `count` taps and strokes, some with two fingers, by its users at places that its camera sees.
TouchScript random_gestures(const RandomRig& rig, int count, std::uint64_t seed);

// Somebody's hand.
HandLooks random_looks(std::uint64_t seed);

}  // namespace telehug
