// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace telehug {

// A straight edge in the picture: u = u_px + slope (v - v_px).
struct FingerEdge {
  double u_px = 0;
  double v_px = 0;
  double slope = 0;

  [[nodiscard]] double u_at(double v) const noexcept { return u_px + slope * (v - v_px); }
};

// The edge near `coarse`, to parts of a pixel: the largest step of colour in row after row of the picture, away from
// where `coarse` crosses the border (its v_px) to both sides, as long as there is one. `scale` is 1 in pictures 720
// rows high. Allocates nothing.
[[nodiscard]] FingerEdge follow_edge(const cv::Mat& bgr, const FingerEdge& coarse, double scale);

}  // namespace telehug
