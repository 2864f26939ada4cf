// SPDX-License-Identifier: Apache-2.0
#include "finger/border_strip.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/simd.hpp"

namespace telehug {

BorderStrip::Layout::Layout(const BorderCurve& border, ImageSize size)
    : image(size),
      columns(0),
      column_px(std::max(1, static_cast<int>(std::lround(column_step_px * size.width_px / 1280.0)))),
      scale(size.height_px / 720.0) {
  columns = size.width_px / column_px;
  first_row.reserve(cells());
  for (int rail = 0; rail < rails; ++rail) {
    for (int column = 0; column < columns; ++column) {
      const double v = border.v_at(column_centre_px(column)) + offset_px(rail);
      first_row.push_back(std::clamp(static_cast<int>(std::floor(v)), 0, size.height_px - 2));
    }
  }
}

// `Width` is the cells' width, or 0 for layout.column_px: known widths take a third of the time.
template <int Width>
TELEHUG_INLINE void BorderStrip::sample_cells(const cv::Mat& bgr, const Layout& layout) {
  const int width_px = Width > 0 ? Width : layout.column_px;
  const float scale = 1.0F / static_cast<float>(2 * width_px);
  for (int rail = 0; rail < rails; ++rail) {
    const int* const first_row = layout.first_row.data() + static_cast<std::ptrdiff_t>(rail) * columns_;
    float* const blue = row(0, rail);
    float* const green = row(1, rail);
    float* const red = row(2, rail);
    for (int column = 0; column < columns_; ++column) {
      const std::uint8_t* above = bgr.ptr<std::uint8_t>(first_row[column]) + channels * column * width_px;
      const std::uint8_t* below = above + bgr.step[0];
      int b = 0;
      int g = 0;
      int r = 0;
      for (int i = 0; i < width_px; ++i, above += channels, below += channels) {
        b += above[0] + below[0];
        g += above[1] + below[1];
        r += above[2] + below[2];
      }
      blue[column] = static_cast<float>(b) * scale;
      green[column] = static_cast<float>(g) * scale;
      red[column] = static_cast<float>(r) * scale;
    }
  }
}

TELEHUG_SIMD void BorderStrip::sample(const cv::Mat& bgr, const Layout& layout) {
  switch (layout.column_px) {
    case 1:
      return sample_cells<1>(bgr, layout);
    case 2:
      return sample_cells<2>(bgr, layout);
    case 3:
      return sample_cells<3>(bgr, layout);
    default:
      return sample_cells<0>(bgr, layout);
  }
}

cv::Mat BorderStrip::picture() const {
  cv::Mat picture(rails, columns_, CV_8UC3);
  for (int rail = 0; rail < rails; ++rail) {
    std::uint8_t* const out = picture.ptr<std::uint8_t>(rail);
    for (int channel = 0; channel < channels; ++channel) {
      for (int i = 0; i < columns_; ++i)
        out[channels * i + channel] = cv::saturate_cast<std::uint8_t>(row(channel, rail)[i]);
    }
  }
  return picture;
}

void BorderStrip::set(const cv::Mat& picture) {
  for (int rail = 0; rail < rails; ++rail) {
    const std::uint8_t* const in = picture.ptr<std::uint8_t>(rail);
    for (int channel = 0; channel < channels; ++channel) {
      for (int i = 0; i < columns_; ++i)
        row(channel, rail)[i] = in[channels * i + channel];
    }
  }
}

}  // namespace telehug
