// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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

// Draws small triangles with a depth buffer. How much of a pixel they cover is found on 8 x 4 points of it, so that
// outlines are true to about 0.1 pixels; colour is found in its middle, and beside an outline taken from the
// neighbours.
class MeshRaster {
 public:
  explicit MeshRaster(cv::Size size);

  // Begins an empty box. Then all triangles are drawn, find_outlines() is called, and all triangles are given to
  // cover_outlines().
  void begin(const cv::Rect& box);
  void draw(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c);
  void find_outlines();
  void cover_outlines(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c);

  // Of the box: CV_32FC4 light (premultiplied) and coverage, CV_32FC1 height.
  void finish(cv::Mat& image, cv::Mat& height_mm) const;

 private:
  void cover(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c, int row);
  void colour(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c, int row);

  [[nodiscard]] int coverage_of_block(int block_row, int block_column) const;
  [[nodiscard]] bool near_outline(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) const;

  struct Rows {
    int first = 0;
    int last = -1;
  };
  [[nodiscard]] Rows rows_of(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) const;

  struct Pixel {
    Light light;
    float height_mm = 0;
  };

  cv::Size size_;
  cv::Rect box_;
  int blocks_across_;
  std::vector<std::uint8_t> block_coverage_;  // of blocks of 8 x 8 pixels: 0 none, 1 full, 2 crossed by an outline
  std::vector<std::uint32_t> covered_;        // 4 rows of 8 points, the upper left one in the lowest bit
  int drawn_stride_;                          // whole blocks, so that eight pixels are looked at at once
  std::vector<std::uint8_t> drawn_;           // 255 where depth_mm_ is that of a triangle
  std::vector<float> depth_mm_;               // nothing drawn: a large number
  std::vector<Pixel> pixels_;
};

}  // namespace telehug
