// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

namespace telehug {

// The lines just within the edges of `box`, `width` px wide, as rectangles that don't overlap, cut to `bounds`. What
// lies outside of `bounds` has no lines: a box that is cut is open at its cut sides. Empty if there is nothing to
// see or `width` isn't above 0.
std::vector<cv::Rect> make_outline(const cv::Rect& box, int width, const cv::Rect& bounds);

}  // namespace telehug
