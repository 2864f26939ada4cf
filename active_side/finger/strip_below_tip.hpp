// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>

#include "common/units.hpp"

namespace telehug {

// N values with places that are signed numbers, as those of pixels are.
template <typename T, std::size_t N>
class Numbered {
 public:
  T& operator[](int place) { return values_[static_cast<std::size_t>(place)]; }
  const T& operator[](int place) const { return values_[static_cast<std::size_t>(place)]; }
  void fill(const T& value) { values_.fill(value); }

 private:
  std::array<T, N> values_{};
};

// The part of a picture below a fingertip where its mirror image may be, as rows of 4 pixels and cells of 1/8 of the
// finger's half width. Its columns follow the image of the screen's normal. Places along a row are in half widths from
// the strip's middle, so that fingers of all sizes look alike.
class StripBelowTip {
 public:
  static constexpr int row_px = 4;
  static constexpr int most_rows = 60;
  static constexpr double reach = 3.5;  // half widths to each side

  // `begin`: middle of the strip's upper end. The strip ends with the picture.
  StripBelowTip(const cv::Mat& bgr, const ImagePoint& begin, double u_per_v, double half_width_px);

  [[nodiscard]] int rows() const noexcept { return rows_; }

  // Whether the strip and the picture reach that far.
  [[nodiscard]] bool holds(int row, double from, double to) const;

  // Mean blue, green and red between two places of a row.
  [[nodiscard]] cv::Vec3f mean(int row, double from, double to) const {
    return (sum_before(row, to) - sum_before(row, from)) * static_cast<float>(1 / ((to - from) * cells_per_half_width));
  }

 private:
  static constexpr int cells_per_half_width = 8;
  static constexpr int cells = static_cast<int>(2 * reach * cells_per_half_width);

  [[nodiscard]] cv::Vec3f sum_before(int row, double place) const;

  int rows_ = 0;
  Numbered<double, most_rows> middle_u_px_;
  double half_width_px_;
  int picture_width_px_;
  Numbered<Numbered<cv::Vec3f, cells + 1>, most_rows> sums_;  // of the cells before each cell
};

}  // namespace telehug
