// SPDX-License-Identifier: Apache-2.0
#include "finger/edge_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace telehug {

EdgeMap::EdgeMap(ImageSize largest) {
  const std::size_t cells =
      static_cast<std::size_t>(largest.width_px / 2 + 1) * static_cast<std::size_t>(largest.height_px / 2 + 1);
  halved_.resize(3 * cells);
  tensors_.resize(cells);
}

void EdgeMap::compute(const cv::Mat& bgr, cv::Rect part) {
  part_ = part & cv::Rect(0, 0, bgr.cols, bgr.rows);
  columns_ = part_.width / 2;
  rows_ = part_.height / 2;
  if (columns_ < 3 || rows_ < 3) {
    columns_ = rows_ = 0;
    return;
  }
  const std::ptrdiff_t width = columns_;
  const std::ptrdiff_t plane = width * rows_;
  for (int j = 0; j < rows_; ++j) {
    const std::uint8_t* above = bgr.ptr<std::uint8_t>(part_.y + 2 * j) + 3 * part_.x;
    const std::uint8_t* below = above + bgr.step[0];
    float* const blue = halved_.data() + j * width;
    float* const green = blue + plane;
    float* const red = green + plane;
    for (int i = 0; i < columns_; ++i, above += 6, below += 6) {
      blue[i] = 0.25F * static_cast<float>(above[0] + above[3] + below[0] + below[3]);
      green[i] = 0.25F * static_cast<float>(above[1] + above[4] + below[1] + below[4]);
      red[i] = 0.25F * static_cast<float>(above[2] + above[5] + below[2] + below[5]);
    }
  }
  std::fill_n(tensors_.begin(), plane, Tensor{});
  for (int j = 1; j + 1 < rows_; ++j) {
    Tensor* const out = tensors_.data() + j * width;
    for (int c = 0; c < 3; ++c) {
      const float* const above = halved_.data() + c * plane + (j - 1) * width;
      const float* const here = above + width;
      const float* const below = here + width;
      for (int i = 1; i + 1 < columns_; ++i) {
        const float du =
            0.25F * (above[i + 1] + 2 * here[i + 1] + below[i + 1] - above[i - 1] - 2 * here[i - 1] - below[i - 1]);
        const float dv =
            0.25F * (below[i - 1] + 2 * below[i] + below[i + 1] - above[i - 1] - 2 * above[i] - above[i + 1]);
        out[i].uu += du * du;
        out[i].uv += du * dv;
        out[i].vv += dv * dv;
      }
    }
  }
}

float EdgeMap::strength(float u, float v, float nu, float nv) const noexcept {
  const float fu = u - static_cast<float>(part_.x);
  const float fv = v - static_cast<float>(part_.y);
  if (fu < 0 || fv < 0) return 0;
  const auto i = static_cast<int>(0.5F * fu);
  const auto j = static_cast<int>(0.5F * fv);
  if (i >= columns_ || j >= rows_) return 0;
  const Tensor& t =
      tensors_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i)];
  const float step = std::sqrt(std::max(0.0F, t.uu * nu * nu + 2 * t.uv * nu * nv + t.vv * nv * nv));
  return step / (step + half_step);
}

}  // namespace telehug
