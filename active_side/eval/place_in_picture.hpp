// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "calibration/calibration.hpp"
#include "common/units.hpp"

namespace telehug {

// Where the pictures of this calibration show a place of the screen, as far as its model knows. Nothing if the camera
// can't see there.
[[nodiscard]] std::optional<ImagePoint> place_in_picture(const Calibration& calibration, const ScreenPoint& place);

}  // namespace telehug
