// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/result.hpp"

namespace telehug {

// CV_8UC3 BGR as a baseline JPEG (4:2:0) of `quality` 1..100.
Result<std::vector<std::uint8_t>> encode_jpeg(const cv::Mat& bgr, int quality);

}  // namespace telehug
