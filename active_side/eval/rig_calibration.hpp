// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "capture/rig_directory.hpp"
#include "common/result.hpp"

namespace telehug {

// Calibrates `model`, "thesis" or "default", from a recording's pictures; default: see default_calibration.hpp. The
// thesis' way: the border from triangle.jpg, else the longest line of
// background.jpg, else that of the first calibration picture; then the finger's length and column in two calibration
// pictures. `frames` are their numbers (1 is calibration/01.jpg), the reference point first; empty: 1 and 2. `date` is
// kept as it is. The error says which picture is missing or unfit and why.
Result<Calibration> calibrate_from_recording(const RigDirectory& rig, const std::string& model,
                                             const std::vector<int>& frames, const std::string& date);

}  // namespace telehug
