// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "common/result.hpp"

namespace telehug {

// Reads a JPEG or PNG file (its content decides, not its name) as CV_8UC3 BGR; transparent parts of a PNG become black.
// Files of more than 64 MB and pictures of more than 8192 pixels a side are refused.
Result<cv::Mat> read_picture(const std::filesystem::path& path);

// Writes CV_8UC3 BGR or CV_8UC1 grey as PNG. The file appears under its name when it is complete.
Status write_png(const std::filesystem::path& path, const cv::Mat& picture);

}  // namespace telehug
