// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "capture/rig_directory.hpp"
#include "common/result.hpp"

namespace telehug {

// The touches of a recording with these numbers (1 is calibration/01.jpg), in their order. The error says which is
// missing.
Result<std::vector<const CalibrationTouch*>> calibration_touches(const RigDirectory& rig,
                                                                 const std::vector<int>& numbers);

}  // namespace telehug
