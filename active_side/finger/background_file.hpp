// SPDX-License-Identifier: Apache-2.0
//
// The background strip beside the calibration file, so that fingers are found from the first frame on: a PNG picture of
// what lies within some 65 rows in front of the screen's bottom edge (bezel and desk), straightened along it. Nothing
// of the screen is in it, and nobody, if nobody was there when it was taken. Its note `telehug background` says
//
//   1 1280x720 507 509 445 447
//
// the file's version, the size of the camera's pictures, and the first and last column's rows of the strip's rail
// nearest to the edge and of that farthest from it.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "common/result.hpp"
#include "finger/border_strip.hpp"

namespace telehug {

// rig.toml: rig.background.png
[[nodiscard]] std::filesystem::path background_file(const std::filesystem::path& calibration_file);

// Keeps the strip of `empty` (CV_8UC3, of the layout's size), which shows the rig with nobody there.
Status write_background(const std::filesystem::path& path, const cv::Mat& empty, const BorderStrip::Layout& layout);

// The error says that the file can't be read, holds no background, or one that was made for another calibration.
Result<BorderStrip> read_background(const std::filesystem::path& path, const BorderStrip::Layout& layout);

}  // namespace telehug
