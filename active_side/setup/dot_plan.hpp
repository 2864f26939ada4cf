// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/rig_camera.hpp"
#include "common/units.hpp"

namespace telehug {

inline constexpr std::size_t full_calibration_dots = 9;
inline constexpr std::size_t quick_calibration_dots = 2;
inline constexpr double least_between_dots_mm = 25;  // so that a finger on one is not near another

// Up to `count` (1 to 9) dots in the order in which they are touched, far to the left and right first. All of each dot
// lies in the camera's picture, `margin_px` from its sides: dots that would not are moved towards the lower middle of
// the screen, and left out if another one is there. None: the camera sees nothing of the screen.
[[nodiscard]] std::vector<ScreenPoint> plan_dots(const RigCamera& camera, const ScreenSize& screen, std::size_t count,
                                                 double margin_px);

// The dot with all of its outline.
[[nodiscard]] bool sees_dot(const RigCamera& camera, const ScreenPoint& dot, double margin_px);

}  // namespace telehug
