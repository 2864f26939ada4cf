// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "common/units.hpp"

namespace telehug {

// How strongly the colour changes at each place of a part of the picture, in any direction: the structure tensor (Di
// Zenzo 1986) of the picture at half its resolution.
class EdgeMap {
 public:
  explicit EdgeMap(ImageSize largest);

  // `part` is cut to the picture. Allocates nothing.
  void compute(const cv::Mat& bgr, cv::Rect part);

  // Of an edge whose normal is (nu, nv), of length 1, at a point of the picture: 0 (none) to 1, 0.5 being a step of
  // half_step grey levels. Outside the part: 0.
  static constexpr float half_step = 15;
  [[nodiscard]] float strength(float u, float v, float nu, float nv) const noexcept {
    const auto i = static_cast<int>(0.5F * (u - static_cast<float>(part_.x)));
    const auto j = static_cast<int>(0.5F * (v - static_cast<float>(part_.y)));
    if (static_cast<unsigned>(i) >= static_cast<unsigned>(columns_)) return 0;
    if (static_cast<unsigned>(j) >= static_cast<unsigned>(rows_)) return 0;
    const float* const t = tensors_.data() + static_cast<std::ptrdiff_t>(3 * j) * columns_ + i;
    const float step2 = t[0] * nu * nu + 2 * t[columns_] * nu * nv + t[2 * columns_] * nv * nv;
    const float step = std::sqrt(std::max(0.0F, step2));
    return step / (step + levels_per_step * half_step);
  }

 private:
  using Level = std::int16_t;
  // Gradient of a step of one grey level: pixels in a cell, weights on one side of Sobel's operator.
  static constexpr float levels_per_step = 4 * 4;

  void halve(const cv::Mat& bgr);
  void differentiate();

  cv::Rect part_;  // of the picture
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Level> two_rows_;  // sums of two rows of the picture
  std::vector<Level> halved_;    // sums of four pixels; three planes
  std::vector<float> tensors_;   // sums of products of gradients; row by row all uu, uv, vv
};

}  // namespace telehug
