// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstdint>

#include "common/messages.hpp"
#include "common/units.hpp"
#include "finger/mirror_state.hpp"
#include "touch/contact_state.hpp"

namespace telehug {

// One finger in one frame, read as if it touched the screen. Seen from the camera (height z0 above the screen's plane,
// its foot at (x0, y0)) a finger at height h over (x, y) is then z0 / (z0 - h) times too far from the foot and too
// wide.
struct FingerObservation {
  ScreenPoint screen;    // may lie below the screen's bottom edge: a hovering finger does
  double width_mm = 0;   // of the finger right behind its tip; 0: not measured
  double px_per_mm = 0;  // of the picture at that place, along the screen's x; 0: unknown
  MirrorEvidence mirror = {};
  double quality = 1;  // of the detection, > 0 to 1: the tip's noise is inversely proportional to it
};

using FingerObservations = boost::container::static_vector<FingerObservation, max_contacts>;

// What is known of fingers that a detector sees as touches, and nothing else.
[[nodiscard]] inline FingerObservations without_evidence(const ScreenPoints& points) {
  FingerObservations fingers;
  for (const ScreenPoint& point : points)
    fingers.push_back({point, 0, 0, {}, 1});
  return fingers;
}

// A picture that stands alone: without a history only the mirror image can tell, and a finger that crosses the border
// touches more often than not.
[[nodiscard]] constexpr bool touches_alone(const FingerObservation& finger) noexcept {
  return finger.mirror.state != MirrorState::hovering;
}

// Something that changes the whole picture (a light switched, a flashing screen, a torn frame) says nothing about
// fingers: nothing begins or ends because of it.
enum class Scene : std::uint8_t { steady, disturbed };

}  // namespace telehug
