// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace telehug {

// What one picture says of a finger: one that touches meets its mirror image, one that hovers leaves a gap of twice its
// height.
enum class MirrorState : std::uint8_t { unknown, touching, hovering };

struct MirrorEvidence {
  MirrorState state = MirrorState::unknown;
  double hover_mm = 0;   // between fingertip and screen; 0 unless it hovers
  double log_ratio = 0;  // ln of how many times likelier that is seen in this state than in the other; 0 to 4
};

}  // namespace telehug
