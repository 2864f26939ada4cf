// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace telehug {

// What the screen's mirror image of a finger says: a finger that touches meets its reflection, one that hovers leaves a
// gap of twice its height.
enum class MirrorState : std::uint8_t { unknown, touching, hovering };

struct MirrorEvidence {
  MirrorState state = MirrorState::unknown;
  double gap_px = 0;      // from the fingertip to the tip of its mirror image; 0 while unknown
  double gap_mm = 0;      // between fingertip and screen: half of gap_px in mm
  double confidence = 0;  // in the state, 0.5 to 1; 0 while unknown
};

}  // namespace telehug
