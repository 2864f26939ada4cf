// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "capture/rig_directory.hpp"
#include "common/result.hpp"

namespace telehug {

// How the recorded rig looks with nobody there: background.jpg, else the median of its calibration pictures, in which
// the hand is every time somewhere else (3 at least). The error says what is missing.
Result<cv::Mat> picture_of_empty_rig(const RigDirectory& rig);

}  // namespace telehug
