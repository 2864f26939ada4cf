// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "capture/rig_directory.hpp"
#include "common/result.hpp"

namespace telehug {

// Calibrates the default model from a recording's pictures: the dots that the calibration pictures show
// under the finger (without dots: the tips from those in which a finger is found), the screen's bottom edge from the
// edges of background.jpg (else triangle.jpg) that agree with them, the triangle's vertex, if there is a triangle.jpg,
// and the marks, if there is a marks.jpg. `frames` are the numbers of the calibration pictures to use (1 is
// calibration/01.jpg); empty: all. `date` is kept as it is.
Result<Calibration> calibrate_default_from_recording(const RigDirectory& rig, const std::vector<int>& frames,
                                                     const std::string& date);

}  // namespace telehug
