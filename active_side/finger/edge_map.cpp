// SPDX-License-Identifier: Apache-2.0
#include "finger/edge_map.hpp"

#include <algorithm>
#include <cstddef>

namespace telehug {
namespace {

constexpr int channels = 3;

struct Gradient {
  std::int16_t du;
  std::int16_t dv;
};

Gradient gradient(const std::int16_t* here, std::ptrdiff_t width) {
  const std::int16_t* const above = here - width;
  const std::int16_t* const below = here + width;
  return {static_cast<std::int16_t>(above[1] + 2 * here[1] + below[1] - above[-1] - 2 * here[-1] - below[-1]),
          static_cast<std::int16_t>(below[-1] + 2 * below[0] + below[1] - above[-1] - 2 * above[0] - above[1])};
}

}  // namespace

EdgeMap::EdgeMap(ImageSize largest) {
  const std::size_t cells =
      static_cast<std::size_t>(largest.width_px / 2 + 1) * static_cast<std::size_t>(largest.height_px / 2 + 1);
  two_rows_.resize(static_cast<std::size_t>(channels) * static_cast<std::size_t>(largest.width_px));
  halved_.resize(channels * cells);
  tensors_.resize(channels * cells);
}

void EdgeMap::compute(const cv::Mat& bgr, cv::Rect part) {
  part_ = part & cv::Rect(0, 0, bgr.cols, bgr.rows);
  columns_ = part_.width / 2;
  rows_ = part_.height / 2;
  if (columns_ < 3 || rows_ < 3) {
    columns_ = rows_ = 0;
    return;
  }
  halve(bgr);
  differentiate();
}

void EdgeMap::halve(const cv::Mat& bgr) {
  const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(columns_) * rows_;
  Level* const both = two_rows_.data();
  for (int j = 0; j < rows_; ++j) {
    const std::uint8_t* const above = bgr.ptr<std::uint8_t>(part_.y + 2 * j) + channels * part_.x;
    const std::uint8_t* const below = above + bgr.step[0];
    for (int i = 0; i < 2 * channels * columns_; ++i)
      both[i] = static_cast<Level>(above[i] + below[i]);
    Level* const blue = halved_.data() + static_cast<std::ptrdiff_t>(j) * columns_;
    Level* const green = blue + plane;
    Level* const red = green + plane;
    for (int i = 0; i < columns_; ++i) {
      const Level* const pixels = both + 2 * channels * i;
      blue[i] = static_cast<Level>(pixels[0] + pixels[3]);
      green[i] = static_cast<Level>(pixels[1] + pixels[4]);
      red[i] = static_cast<Level>(pixels[2] + pixels[5]);
    }
  }
}

// By Sobel's operator; the outermost cells have no gradient.
void EdgeMap::differentiate() {
  const std::ptrdiff_t width = columns_;
  const std::ptrdiff_t plane = width * rows_;
  std::fill_n(tensors_.begin(), channels * width, 0.0F);
  std::fill_n(tensors_.begin() + channels * (plane - width), channels * width, 0.0F);
  for (int j = 1; j + 1 < rows_; ++j) {
    const Level* const blue = halved_.data() + j * width;
    const Level* const green = blue + plane;
    const Level* const red = green + plane;
    float* const uu = tensors_.data() + channels * j * width;
    float* const uv = uu + width;
    float* const vv = uv + width;
    for (std::ptrdiff_t i = 1; i + 1 < width; ++i) {
      const Gradient b = gradient(blue + i, width);
      const Gradient g = gradient(green + i, width);
      const Gradient r = gradient(red + i, width);
      uu[i] = static_cast<float>(b.du * b.du + g.du * g.du + r.du * r.du);
      uv[i] = static_cast<float>(b.du * b.dv + g.du * g.dv + r.du * r.dv);
      vv[i] = static_cast<float>(b.dv * b.dv + g.dv * g.dv + r.dv * r.dv);
    }
    for (float* const row : {uu, uv, vv})
      row[0] = row[width - 1] = 0;
  }
}

}  // namespace telehug
