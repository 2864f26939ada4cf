// SPDX-License-Identifier: Apache-2.0
#include "finger/overview.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>

#include "common/simd.hpp"
#include "finger/background_strip.hpp"
#include "finger/pixel_sums.hpp"

namespace telehug {
namespace {

constexpr double edge_reach_cells = 16;  // the distance from the edge is told up to here
constexpr int least_cells = 16;
constexpr int rows_beyond = 8;  // as the nets learned: fingers may end right at the picture's end
constexpr int most_cell_px = 64;
constexpr std::size_t channels = 5;

// A finger's tip lies at most so far beside the columns in which it crosses the strip.
constexpr std::array<int, Overview::tile_widths> usual_tile_columns{88, 112, 128};
constexpr int beside_columns = 30;
// Standard deviations from the background, and in how many cells of a column; noise hardly ever reaches that.
constexpr float different = 2.5F;
constexpr int least_different = 3;

// Which rail of the strip lies `offset_px` rows (in pictures 720 rows high) in front of the edge; -1: none.
int rail_at(double offset_px) {
  constexpr double between_px = 20;  // near rails before, the others beyond
  if (offset_px < 2 || offset_px > 68) return -1;
  if (offset_px < between_px) return std::clamp(static_cast<int>(std::lround((offset_px - 3) / 2)), 0, 7);
  return std::clamp(8 + static_cast<int>(std::lround((offset_px - 23) / 6)), 8, BorderStrip::rails - 1);
}

int cell_px_of(double px_per_mm) {
  return std::clamp(static_cast<int>(std::lround(Overview::cell_mm * px_per_mm)), 1, most_cell_px);
}

}  // namespace

int Overview::first_row_px(const BorderCurve& border, ImageSize image, double px_per_mm) {
  double highest_px = image.height_px;
  for (int u = 0; u < image.width_px; ++u)
    highest_px = std::min(highest_px, border.v_at(u));
  const int in_front_px = static_cast<int>(std::lround(in_front_mm / cell_mm)) * cell_px_of(px_per_mm);
  return std::clamp(static_cast<int>(highest_px) - in_front_px, 0, image.height_px);
}

Overview::Overview(const BorderCurve& border, const BorderStrip::Layout& strip, double px_per_mm)
    : cell_px_(cell_px_of(px_per_mm)),
      first_row_px_(first_row_px(border, strip.image, px_per_mm)),
      cells_of_strip_(std::max(1, cell_px_ / strip.column_px)) {
  const ImageSize& image = strip.image;
  columns_ = image.width_px / cell_px_;
  for (std::size_t i = 0; i < tile_widths; ++i)
    tile_columns_[i] = std::min(columns_, usual_tile_columns[i]);
  seen_rows_ = (image.height_px - first_row_px_) / cell_px_;
  if (columns_ < least_cells || seen_rows_ < least_cells) {
    throw std::invalid_argument("too little of the screen is in the picture to look for fingers");
  }
  rows_ = seen_rows_ + rows_beyond;
  sums_.resize(static_cast<std::size_t>(columns_ * cell_px_) * 3);
  different_.resize(static_cast<std::size_t>(columns_));
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const ImagePoint middle = picture_point(column, std::min(row, seen_rows_ - 1));
      const double beyond_px = middle.v_px - border.v_at(middle.u_px);
      const int rail = rail_at(-beyond_px / strip.scale);
      const int first = std::clamp(column * cell_px_ / strip.column_px, 0, strip.columns - cells_of_strip_);
      if (rail >= 0) {
        const int start = rail * strip.columns + first;
        strip_cells_.push_back({cell(row, column), static_cast<std::size_t>(column), static_cast<std::size_t>(start)});
      }
      beyond_edge_.push_back(static_cast<float>(std::clamp(beyond_px / cell_px_ / edge_reach_cells, -1.0, 1.0)));
    }
  }
  difference_.resize(beyond_edge_.size());
}

const Overview::Tiles& Overview::tiles(const std::vector<float>& distance) {
  const float share = 1 / static_cast<float>(cells_of_strip_);
  std::fill(different_.begin(), different_.end(), 0);
  for (const StripCell& cell : strip_cells_) {
    const float* const here = &distance[cell.start];
    const float mean = share * std::accumulate(here, here + cells_of_strip_, 0.0F);
    difference_[cell.cell] = mean / BackgroundStrip::far;
    different_[cell.column] += mean > different ? 1 : 0;
  }
  tiles_.clear();
  const auto differs = [this](int column) { return different_[static_cast<std::size_t>(column)] >= least_different; };
  const auto room_in = [](int columns) { return std::max(1, columns - 2 * beside_columns); };
  const int room = room_in(tile_columns_.back());
  for (int column = 0; column < columns_ && tiles_.size() < most_tiles;) {
    if (!differs(column)) {
      ++column;
      continue;
    }
    int last = column;
    for (int i = column; i < std::min(column + room, columns_); ++i)
      last = differs(i) ? i : last;
    std::size_t width = 0;
    while (width + 1 < tile_widths && last - column >= room_in(tile_columns_[width]))
      ++width;
    const int wide = tile_columns_[width];
    tiles_.push_back({std::clamp((column + last + 1 - wide) / 2, 0, columns_ - wide), width});
    column = last + 1;
  }
  return tiles_;
}

// One row of cells from `cell_px` rows of pixels, whose first is at `pixels`. `Width` is cell_px, or 0 for any: known
// widths take half the time.
template <int Width>
TELEHUG_INLINE void Overview::average_row(const std::uint8_t* pixels, std::size_t row_bytes, int column_count,
                                          float* cells) {
  const int width = Width > 0 ? Width : cell_px_;
  const std::size_t count = static_cast<std::size_t>(column_count * width) * bytes_of_pixel;
  unsigned short* const sums = sums_.data();
  add_rows(pixels, row_bytes, width, count, sums);
  if constexpr (Width > 0) add_next_pixels<Width>(count, sums);
  const float scale = 1 / (127.5F * static_cast<float>(width * width));
  const unsigned short* sum = sums;
  for (int column = 0; column < column_count; ++column, cells += channels) {
    for (std::size_t k = 0; k < bytes_of_pixel; ++k) {
      unsigned block = sum[k];
      if constexpr (Width == 0) {
        for (int i = 1; i < width; ++i)
          block += sum[static_cast<std::size_t>(i) * bytes_of_pixel + k];
      }
      cells[k] = static_cast<float>(block) * scale - 1;
    }
    sum += static_cast<std::size_t>(width) * bytes_of_pixel;
  }
}

TELEHUG_SIMD void Overview::sample(const cv::Mat& bgr, int first_column, int column_count, float* cells) {
  const auto first_byte = static_cast<std::ptrdiff_t>(first_column) * cell_px_ * 3;
  for (int row = 0; row < rows_; ++row, cells += static_cast<std::size_t>(column_count) * channels) {
    const int seen_row = std::min(row, seen_rows_ - 1);
    const auto* const pixels = bgr.ptr<std::uint8_t>(first_row_px_ + seen_row * cell_px_) + first_byte;
    switch (cell_px_) {
      case 4:
        average_row<4>(pixels, bgr.step[0], column_count, cells);
        break;
      case 5:
        average_row<5>(pixels, bgr.step[0], column_count, cells);
        break;
      case 6:
        average_row<6>(pixels, bgr.step[0], column_count, cells);
        break;
      case 7:
        average_row<7>(pixels, bgr.step[0], column_count, cells);
        break;
      case 8:
        average_row<8>(pixels, bgr.step[0], column_count, cells);
        break;
      default:
        average_row<0>(pixels, bgr.step[0], column_count, cells);
        break;
    }
    const std::size_t start = cell(row, first_column);
    for (std::size_t column = 0; column < static_cast<std::size_t>(column_count); ++column) {
      cells[column * channels + 3] = difference_[start + column];
      cells[column * channels + 4] = beyond_edge_[start + column];
    }
  }
}

}  // namespace telehug
