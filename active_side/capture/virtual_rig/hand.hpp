// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "capture/virtual_rig/round_cone.hpp"
#include "capture/virtual_rig/touch_script.hpp"

namespace telehug {

inline constexpr double fingertip_radius_mm = 5.5;

// A right hand that points at the screen with its index finger, out of round cones: the finger (from the tip on), the
// palm, the forearm, the thumb and the other fingers, bent.
using Hand = std::array<RoundCone, 12>;
Hand hand_at(const FingerPlace& place);

}  // namespace telehug
