// SPDX-License-Identifier: Apache-2.0
#include "finger/aligned_patch.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace telehug {

AlignedPatch::AlignedPatch(ImageSize largest) {
  if (largest.width_px < 2 * margin_px || largest.height_px < 2 * margin_px) {
    throw std::invalid_argument("a picture of this size is too small to look for fingers");
  }
  const std::size_t bytes = 3 * static_cast<std::size_t>(largest.width_px);
  pixels_.resize(bytes * static_cast<std::size_t>(largest.height_px));
  filtered_.resize(pixels_.size());
  line_.resize(bytes);
  line_sums_.resize(bytes);
}

void AlignedPatch::cut(const cv::Mat& bgr, const BorderLine& border, int first_row, int rows, int first_column,
                       int columns) {
  first_row_ = first_row;
  rows_ = rows;
  first_column_ = first_column;
  columns_ = columns;
  // Columns of equal shift are copied together: a few runs a row, each a memcpy.
  for (int column = 0; column < columns;) {
    const int u = std::clamp(first_column + column, 0, bgr.cols - 1);
    const auto shift = static_cast<int>(std::lround(border.v_at(u)));
    int end = column + 1;
    const bool inside = first_column + column == u;
    while (inside && end < columns && first_column + end < bgr.cols &&
           std::lround(border.v_at(first_column + end)) == shift) {
      ++end;
    }
    for (int row = 0; row < rows; ++row) {
      const int v = std::clamp(shift + first_row + row, 0, bgr.rows - 1);
      std::memcpy(pixels_.data() + offset(row) + 3 * static_cast<std::size_t>(column),
                  bgr.ptr<std::uint8_t>(v) + 3 * static_cast<std::size_t>(u),
                  3 * static_cast<std::size_t>(end - column));
    }
    column = end;
  }
}

void AlignedPatch::erode_dilate_smooth() {
  filter_3x3([](std::uint8_t a, std::uint8_t b) { return std::min(a, b); });
  filter_3x3([](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
  smooth_3x3();
}

template <typename Pick>
void AlignedPatch::filter_3x3(Pick pick) {
  const std::size_t n = row_bytes();
  std::uint8_t* const line = line_.data();
  for (int row = 0; row < rows_; ++row) {
    const std::uint8_t* const above = pixels_.data() + offset(std::max(row - 1, 0));
    const std::uint8_t* const here = pixels_.data() + offset(row);
    const std::uint8_t* const below = pixels_.data() + offset(std::min(row + 1, rows_ - 1));
    for (std::size_t i = 0; i < n; ++i) {
      line[i] = pick(pick(above[i], here[i]), below[i]);
    }
    std::uint8_t* const out = filtered_.data() + offset(row);
    for (std::size_t i = 3; i + 3 < n; ++i) {
      out[i] = pick(pick(line[i - 3], line[i]), line[i + 3]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      out[i] = pick(line[i], line[i + 3]);
      out[n - 3 + i] = pick(line[n - 3 + i], line[n - 6 + i]);
    }
  }
  pixels_.swap(filtered_);
}

void AlignedPatch::smooth_3x3() {
  const std::size_t n = row_bytes();
  std::uint16_t* const line = line_sums_.data();
  for (int row = 0; row < rows_; ++row) {
    const std::uint8_t* const above = pixels_.data() + offset(std::max(row - 1, 0));
    const std::uint8_t* const here = pixels_.data() + offset(row);
    const std::uint8_t* const below = pixels_.data() + offset(std::min(row + 1, rows_ - 1));
    for (std::size_t i = 0; i < n; ++i) {
      line[i] = static_cast<std::uint16_t>(above[i] + 2 * here[i] + below[i]);
    }
    std::uint8_t* const out = filtered_.data() + offset(row);
    for (std::size_t i = 3; i + 3 < n; ++i) {
      out[i] = static_cast<std::uint8_t>((line[i - 3] + 2 * line[i] + line[i + 3] + 8) / 16);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      out[i] = static_cast<std::uint8_t>((3 * line[i] + line[i + 3] + 8) / 16);
      out[n - 3 + i] = static_cast<std::uint8_t>((3 * line[n - 3 + i] + line[n - 6 + i] + 8) / 16);
    }
  }
  pixels_.swap(filtered_);
}

}  // namespace telehug
