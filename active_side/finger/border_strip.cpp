// SPDX-License-Identifier: Apache-2.0
#include "finger/border_strip.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/simd.hpp"
#include "finger/pixel_sums.hpp"

namespace telehug {
namespace {

constexpr int rows_of_cell = 2;

}  // namespace

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
      const int row = std::clamp(static_cast<int>(std::floor(v)), 0, size.height_px - 2);
      if (column == 0 || row != first_row.back()) runs.push_back({rail, column, column, row});
      runs.back().end_column = column + 1;
      first_row.push_back(row);
    }
  }
}

// `Width` is the cells' width, or 0 for layout.column_px: known widths take a third of the time.
template <int Width>
TELEHUG_INLINE void BorderStrip::sample_cells(const cv::Mat& bgr, const Layout& layout) {
  const int width_px = Width > 0 ? Width : layout.column_px;
  const std::size_t cell_bytes = bytes_of_pixel * static_cast<std::size_t>(width_px);
  const float scale = 1.0F / static_cast<float>(rows_of_cell * width_px);
  for (const Layout::Run& run : layout.runs) {
    const std::uint8_t* const pixels =
        bgr.ptr<std::uint8_t>(run.row) + static_cast<std::size_t>(run.first_column) * cell_bytes;
    const auto count = static_cast<std::size_t>(run.end_column - run.first_column) * cell_bytes;
    add_rows(pixels, bgr.step[0], rows_of_cell, count, sums_.data());
    if constexpr (Width > 0) add_next_pixels<Width>(count, sums_.data());
    float* const blue = row(0, run.rail);
    float* const green = row(1, run.rail);
    float* const red = row(2, run.rail);
    const unsigned short* sum = sums_.data();
    for (int column = run.first_column; column < run.end_column; ++column, sum += cell_bytes) {
      int b = sum[0];
      int g = sum[1];
      int r = sum[2];
      if constexpr (Width == 0) {
        for (std::size_t i = bytes_of_pixel; i < cell_bytes; i += bytes_of_pixel) {
          b += sum[i];
          g += sum[i + 1];
          r += sum[i + 2];
        }
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
