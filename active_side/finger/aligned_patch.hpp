// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "calibration/border_line.hpp"
#include "common/units.hpp"

namespace telehug {

// A region of a picture, cut so that the border is level: row 0 lies on the border, negative rows above it (desk,
// bezel), positive ones below it (screen). Every column is shifted by whole pixels. Pixels are B, G, R bytes.
//
// Erosion, dilation and smoothing are own 3x3 loops because OpenCV's allocate inside; after construction nothing here
// does. Their windows shrink at the patch's edge, so that the outer `margin_px` pixels of a filtered patch differ from
// a filtered picture.
class AlignedPatch {
 public:
  static constexpr int margin_px = 3;  // one pixel for each of the three filters

  // `largest` is the largest region that will ever be cut.
  explicit AlignedPatch(ImageSize largest);

  // `bgr` is CV_8UC3; parts of the region that lie outside it repeat its nearest row or column. The region must not be
  // larger than `largest`.
  void cut(const cv::Mat& bgr, const BorderLine& border, int first_row, int rows, int first_column, int columns);

  // Smallest value, then largest value, then the binomial mean of the 3x3 neighbours, for each colour.
  void erode_dilate_smooth();

  [[nodiscard]] int first_row() const noexcept { return first_row_; }
  [[nodiscard]] int rows() const noexcept { return rows_; }
  [[nodiscard]] int first_column() const noexcept { return first_column_; }
  [[nodiscard]] int columns() const noexcept { return columns_; }

  // The pixels of row `row` (relative to the border) from picture column `column` on.
  [[nodiscard]] const std::uint8_t* pixels(int row, int column) const noexcept {
    return pixels_.data() + offset(row - first_row_) + 3 * static_cast<std::size_t>(column - first_column_);
  }

 private:
  [[nodiscard]] std::size_t row_bytes() const noexcept { return 3 * static_cast<std::size_t>(columns_); }
  [[nodiscard]] std::size_t offset(int row) const noexcept { return static_cast<std::size_t>(row) * row_bytes(); }

  template <typename Pick>
  void filter_3x3(Pick pick);
  void smooth_3x3();

  int first_row_ = 0;
  int rows_ = 0;
  int first_column_ = 0;
  int columns_ = 0;
  std::vector<std::uint8_t> pixels_;
  std::vector<std::uint8_t> filtered_;
  std::vector<std::uint8_t> line_;        // one row, filtered vertically
  std::vector<std::uint16_t> line_sums_;  // the same for sums
};

}  // namespace telehug
