// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace telehug {

// The middle value of every pixel's channel: what moves through the pictures is in none of them for long. All are
// CV_8UC3 and of one size, and there is one at least.
[[nodiscard]] cv::Mat median_picture(const std::vector<cv::Mat>& pictures);

}  // namespace telehug
