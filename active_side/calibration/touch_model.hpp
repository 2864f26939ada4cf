// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "calibration/rig_model.hpp"
#include "calibration/thesis_touch_model.hpp"

namespace telehug {

// What turns what a detector sees of a finger into a point on the screen.
using TouchModel = std::variant<ThesisTouchModel, RigModel>;

}  // namespace telehug
