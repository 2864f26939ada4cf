// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "body_map/body_map.hpp"
#include "body_map/screen_scale.hpp"

namespace telehug {

// A copy of a picture of the whole desktop (CV_8UC3) with the face in yellow and the boxes and their numbers in red;
// the box `touched` is filled (0: none).
cv::Mat draw_body_map(const cv::Mat& bgr, const BodyMap& map, const ScreenScale& scale, std::uint16_t touched = 0);

}  // namespace telehug
