// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "capture/virtual_rig/linear_light.hpp"

namespace telehug {

struct RasterVertex {
  float u_px = 0;
  float v_px = 0;
  float depth_mm = 0;
  Light light;
  float height_mm = 0;  // above the screen
};

// The smallest range that holds both; empty ones hold nothing.
cv::Range joined(const cv::Range& a, const cv::Range& b);

// Draws small triangles with a depth buffer. How much of a pixel they cover is found on 8 x 4 points of it, so that
// outlines are true to about 0.1 pixels; colour is found in its middle, and beside an outline taken from the
// neighbours.
class MeshRaster {
 public:
  explicit MeshRaster(cv::Size size);

  // Begins an empty box. Then all triangles are drawn, find_outlines() is called, and all triangles are given to
  // cover_outlines(). If not `exactly`, pixels are covered whose middle is.
  void begin(const cv::Rect& box);
  void draw(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c);
  void find_outlines(bool exactly = true);
  void cover_outlines(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c);

  [[nodiscard]] const cv::Rect& box() const noexcept { return box_; }

  // All columns of a row of the box where something was drawn, and some more.
  [[nodiscard]] cv::Range columns(int v) const { return columns_[static_cast<std::size_t>(v / block_px)]; }
  [[nodiscard]] cv::Range columns_within(const cv::Range& v) const;

  // Calls step(u, light, coverage, height_mm) for each pixel of a row that is covered.
  template <typename Step>
  void row(int v, const cv::Range& of_columns, Step&& step) const {
    if (v < box_.y || v >= box_.y + box_.height) return;
    const cv::Range within = columns(v) & of_columns;
    const std::size_t line = static_cast<std::size_t>(v) * static_cast<std::size_t>(size_.width);
    const int blocks_above = v / block_px * blocks_across_;
    const std::uint8_t* coverage = &block_coverage_[static_cast<std::size_t>(blocks_above)];
    for (int u = within.start; u < within.end;) {
      const int end = std::min(within.end, (u / block_px + 1) * block_px);
      const std::uint8_t of_block = coverage[u / block_px];
      if (of_block == 0) u = end;
      for (; u < end; ++u) {
        const std::size_t i = line + static_cast<std::size_t>(u);
        if (of_block == 1) {
          step(u, pixels_[i].light, 1.0F, pixels_[i].height_mm);
        } else if (covered_[i] != 0) {
          Pixel pixel = pixels_[i];
          if (depth_mm_[i] == nothing_mm && !take_from_neighbours(u, v, pixel)) continue;
          step(u, pixel.light, static_cast<float>(std::popcount(covered_[i])) / 32, pixel.height_mm);
        }
      }
    }
  }

 private:
  static constexpr int block_px = 4;
  static constexpr float nothing_mm = std::numeric_limits<float>::max();

  struct Pixel {
    Light light;
    float height_mm = 0;
  };

  [[nodiscard]] bool beside_box(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) const;
  [[nodiscard]] int coverage_of_block(int block_row, int block_column) const;
  [[nodiscard]] bool near_outline(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) const;
  void cover_drawn(int v, int from, int to);
  void cover(int row, int part, float from, float to);
  bool take_from_neighbours(int u, int v, Pixel& pixel) const;

  cv::Size size_;
  cv::Rect box_;
  bool exactly_ = true;
  int blocks_across_;
  std::vector<std::uint8_t> block_coverage_;  // of blocks of 4 x 4 pixels: 0 none, 1 full, 2 crossed by an outline
  std::vector<cv::Range> columns_;            // of rows of blocks
  std::vector<std::uint32_t> covered_;        // near outlines: 4 rows of 8 points, the upper left one in the lowest bit
  int drawn_stride_;                          // whole blocks, so that four pixels are looked at at once
  std::vector<std::uint8_t> drawn_;           // 255 where depth_mm_ is that of a triangle
  std::vector<float> depth_mm_;               // nothing drawn: a large number
  std::vector<Pixel> pixels_;
};

}  // namespace telehug
