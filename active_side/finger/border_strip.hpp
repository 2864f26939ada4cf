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
  static constexpr int near_rails = 8;      // on the bezel, where neither other fingers nor shadows disturb much
  static constexpr int column_step_px = 2;  // width of a cell in pictures of 1280 columns
  static constexpr int channels = 3;

  // Where the cells lie in pictures of one size and one border. Rails that leave the picture repeat its first rows.
  struct Layout {
    Layout(const BorderCurve& border, ImageSize image);

    ImageSize image;
    int columns;
    int column_px;               // width of a cell
    double scale;                // of lengths: 1 in pictures 720 rows high
    std::vector<int> first_row;  // of each cell: the upper one of the two rows that it averages
    // Neighbouring cells of a rail in the same rows.
    struct Run {
      int rail;
      int first_column;
      int end_column;
      int row;
    };
    std::vector<Run> runs;  // all cells, once each
    // Rows from the edge to the rail: near ones 3, 5, ... 17 in front of it, the others 23, 29, ... 65.
    [[nodiscard]] double offset_px(int rail) const noexcept {
      return -scale * (rail < near_rails ? 3 + 2 * rail : 23 + 6 * (rail - near_rails));
    }
    [[nodiscard]] double column_centre_px(int column) const noexcept { return (column + 0.5) * column_px - 0.5; }
    [[nodiscard]] std::size_t cells() const noexcept { return static_cast<std::size_t>(columns) * rails; }
  };

  explicit BorderStrip(const Layout& layout)
      : columns_(layout.columns),
        values_(layout.cells() * channels, 0.0F),
        sums_(static_cast<std::size_t>(layout.image.width_px) * channels) {}

  // `bgr` is CV_8UC3 of the layout's size. Allocates nothing.
  void sample(const cv::Mat& bgr, const Layout& layout);

  // As a picture (CV_8UC3, columns by rails) to keep it in a file, and back.
  [[nodiscard]] cv::Mat picture() const;
  void set(const cv::Mat& picture);

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
  std::vector<unsigned short> sums_;  // of the pixels of some neighbouring cells
};

}  // namespace telehug
