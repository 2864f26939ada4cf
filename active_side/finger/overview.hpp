// SPDX-License-Identifier: Apache-2.0
//
// The picture about the screen's bottom edge at a coarse scale, as the finger net looks at it: from a hand's breadth in
// front of the edge to the picture's end, a pixel being some 1.75 mm at the edge.
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "calibration/border_curve.hpp"
#include "common/units.hpp"
#include "finger/border_strip.hpp"

namespace telehug {

// A grid of rows() by columns() cells; the last rows repeat the last one that the picture holds. It is looked at in
// tiles, all of its rows by as many columns as one of tile_columns() says: where nothing differs from the background
// there is no finger to be found.
class Overview {
 public:
  static constexpr double cell_mm = 1.75;
  static constexpr double in_front_mm = 42;  // what is seen of the desk
  static constexpr std::size_t most_tiles = 8;
  static constexpr std::size_t tile_widths = 3;
  struct Tile {
    int first_column;
    std::size_t width;  // which one of tile_columns()
  };
  using Tiles = boost::container::static_vector<Tile, most_tiles>;

  // `px_per_mm`: of the picture at the middle of the screen's bottom edge, > 0. Throws std::invalid_argument if the
  // picture has too few cells.
  Overview(const BorderCurve& border, const BorderStrip::Layout& strip, double px_per_mm);

  // The picture's first row that is looked at.
  [[nodiscard]] static int first_row_px(const BorderCurve& border, ImageSize image, double px_per_mm);

  // With the result of BackgroundStrip::distance(): the tiles in which all that differs from the
  // background lies, each far enough from the tile's sides: narrow ones about one finger, wider ones about hands.
  // Allocates nothing.
  const Tiles& tiles(const std::vector<float>& distance);

  // Writes the cells of all rows of some columns, row by row, five values each: blue, green, red (-1 dark to 1 bright),
  // how much the cell differs from the background (0 not to 1 at all; known on the border strip only, else 0; of the
  // last tiles()), and how far it is beyond the screen's edge (-1 in front of it to 1 on the screen). `bgr` is CV_8UC3
  // of the layout's size. Allocates nothing.
  void sample(const cv::Mat& bgr, int first_column, int column_count, float* cells);

  [[nodiscard]] int columns() const noexcept { return columns_; }
  [[nodiscard]] int rows() const noexcept { return rows_; }
  // Never falling; in small pictures they are the same.
  [[nodiscard]] const std::array<int, tile_widths>& tile_columns() const noexcept { return tile_columns_; }

  [[nodiscard]] double cell_px() const noexcept { return cell_px_; }
  // Where the middle of a cell is in the picture. Cells count from 0; parts of them are allowed.
  [[nodiscard]] ImagePoint picture_point(double column, double row) const noexcept {
    return {(column + 0.5) * cell_px_ - 0.5, first_row_px_ + (row + 0.5) * cell_px_ - 0.5};
  }
  // The inverse: the cell's column and row as u_px and v_px.
  [[nodiscard]] ImagePoint cell_of(const ImagePoint& point) const noexcept {
    return {(point.u_px + 0.5) / cell_px_ - 0.5, (point.v_px - first_row_px_ + 0.5) / cell_px_ - 0.5};
  }

 private:
  // A cell that lies in the strip, and the first of the strip's cells in it.
  struct StripCell {
    std::size_t cell;
    std::size_t column;
    std::size_t start;
  };

  [[nodiscard]] std::size_t cell(int row, int column) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  template <int Width>
  void average_row(const std::uint8_t* pixels, std::size_t row_bytes, int column_count, float* cells);

  int cell_px_;
  int first_row_px_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  int seen_rows_ = 0;
  std::array<int, tile_widths> tile_columns_{};
  int cells_of_strip_;  // how many columns of the strip lie in one cell
  std::vector<StripCell> strip_cells_;
  std::vector<float> beyond_edge_;    // of each cell
  std::vector<float> difference_;     // of each cell from the background; 0 where the strip is not
  std::vector<int> different_;        // of each column: how many cells are
  std::vector<unsigned short> sums_;  // of the picture's columns, over a cell's rows
  Tiles tiles_;
};

}  // namespace telehug
