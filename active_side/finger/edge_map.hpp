// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  [[nodiscard]] float strength(float u, float v, float nu, float nv) const noexcept;

 private:
  struct Tensor {
    float uu = 0;
    float uv = 0;
    float vv = 0;
  };

  cv::Rect part_;  // of the picture
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> halved_;  // three planes
  std::vector<Tensor> tensors_;
};

}  // namespace telehug
