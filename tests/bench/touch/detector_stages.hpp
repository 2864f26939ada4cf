// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "bench/touch/figure.hpp"
#include "calibration/border_curve.hpp"
#include "calibration/rig_camera.hpp"

namespace telehug {

// How long each stage of the default detector takes in a frame, for all fingers of it together.
Figures measure_stages(const BorderCurve& border, const RigCamera& camera, const cv::Mat& empty,
                       const std::vector<cv::Mat>& pictures, const std::string& suffix);

}  // namespace telehug
