// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "capture/virtual_rig/mesh_raster.hpp"

namespace telehug {

// Something that is laid over a part of the picture. Outside of each row's `columns` it is empty.
struct PictureLayer {
  cv::Rect box;
  cv::Mat image;                   // CV_32FC4 of the box: blue, green, red times the coverage, and the coverage
  cv::Mat height_mm;               // CV_32FC1, above the screen, where it covers
  std::vector<cv::Range> columns;  // of each row of the box, counted from its left side

  // What was drawn.
  void take(const MeshRaster& raster);
  void clear();

  // Before it is blurred by as much.
  void widen_columns(int by_rows, int by_columns);

  // Columns of the picture where something lies in its rows `v`; empty if nothing does.
  [[nodiscard]] cv::Range columns_within(const cv::Range& v) const;
};

}  // namespace telehug
