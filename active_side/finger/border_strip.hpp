// SPDX-License-Identifier: Apache-2.0
//
// What lies in front of the screen's bottom edge in the picture - bezel, monitor foot, desk - sampled along curves that
// keep their distance from the edge's image. Nothing of the screen is in it, so it changes only with the light, and
// with whoever reaches across.
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "calibration/border_curve.hpp"

namespace telehug {

// Cells of `rails` rows (0 is next to the edge) by `columns`, in three planes: blue, green, red, 0..255.
class BorderStrip {
 public:
  static constexpr int rails = 16;
  static constexpr int rail_step_px = 4;    // rail r is 4 (r + 1) rows in front of the edge, in a picture 720 rows high
  static constexpr int column_step_px = 2;  // and cells are two pixels wide there
  static constexpr int channels = 3;

  // Where the cells lie in pictures of one size and one border. Rails that leave the picture repeat its first rows.
  struct Layout {
    Layout(const BorderCurve& border, ImageSize image);

    ImageSize image;
    int columns;
    int column_px;               // width of a cell
    double rail_px;              // distance of two rails
    std::vector<int> first_row;  // of each cell: the upper one of the two rows that it averages
    [[nodiscard]] double offset_px(int rail) const noexcept { return -rail_px * (rail + 1); }
    [[nodiscard]] double column_centre_px(int column) const noexcept { return (column + 0.5) * column_px - 0.5; }
    [[nodiscard]] std::size_t cells() const noexcept { return static_cast<std::size_t>(columns) * rails; }
  };

  explicit BorderStrip(const Layout& layout) : columns_(layout.columns), values_(layout.cells() * channels, 0.0F) {}

  // `bgr` is CV_8UC3 of the layout's size. Allocates nothing.
  void sample(const cv::Mat& bgr, const Layout& layout);

  [[nodiscard]] int columns() const noexcept { return columns_; }
  // The rail's row of one channel, columns() long.
  [[nodiscard]] const float* row(int channel, int rail) const noexcept { return values_.data() + start(channel, rail); }
  [[nodiscard]] float* row(int channel, int rail) noexcept { return values_.data() + start(channel, rail); }

 private:
  template <int Width>
  void sample_cells(const cv::Mat& bgr, const Layout& layout);
  [[nodiscard]] std::size_t start(int channel, int rail) const noexcept {
    return static_cast<std::size_t>(channel * rails + rail) * static_cast<std::size_t>(columns_);
  }

  int columns_;
  std::vector<float> values_;
};

}  // namespace telehug
