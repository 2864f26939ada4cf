// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "calibration/calibration.hpp"
#include "common/result.hpp"

namespace telehug {

struct CalibratedRig {
  Calibration calibration;
  std::optional<cv::Mat> empty;  // how the camera sees the rig with nobody there
};

// Writes the calibration's file and, beside it, the background. The background first: a daemon that runs reads both
// when the calibration has changed. Without one an older background is removed, and `run` learns it from its first
// pictures.
[[nodiscard]] Status save_calibrated_rig(const std::filesystem::path& path, const CalibratedRig& rig);

}  // namespace telehug
