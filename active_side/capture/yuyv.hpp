// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "common/row_range.hpp"

namespace telehug {

// Fills `rows` of `bgr` (CV_8UC3, whose memory is kept if its size fits) from the picture `yuyv` (CV_8UC2). The other
// rows keep what they held; they are black if the memory is new.
void convert_yuyv(const cv::Mat& yuyv, cv::Mat& bgr, RowRange rows);

}  // namespace telehug
