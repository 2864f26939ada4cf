// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/units.hpp"

namespace telehug {

// A straight piece of an edge; `left` has the smaller column.
struct LineSegment {
  ImagePoint left;
  ImagePoint right;
};

[[nodiscard]] double length_px(const LineSegment& segment);
// Angle to the rows in degrees, -90..90; positive: falls to the right in the picture.
[[nodiscard]] double inclination_deg(const LineSegment& segment);

// The straight edges of a picture (CV_8UC3) after erosion, dilation and smoothing.
std::vector<LineSegment> find_line_segments(const cv::Mat& bgr);

}  // namespace telehug
