// SPDX-License-Identifier: Apache-2.0
//
// What the camera sees about a fingertip, at a scale that does not depend on camera and place, as the tip net looks at
// it.
#pragma once

#include <opencv2/core/mat.hpp>

#include "common/units.hpp"

namespace telehug {

// Columns per mm of the screen's x in patches. A finger is 30 to 50 of them wide.
inline constexpr double patch_px_per_mm = 2.5;
// Rows lie closer: far from the camera a row of the picture is 2 mm of the screen high, a column 0.3 mm wide.
inline constexpr double patch_rows_per_column = 1.5;

// Where a patch lies in the picture.
struct PatchPlace {
  ImagePoint middle;       // of the patch
  double step_px = 1;      // picture pixels per patch column, > 0
  double row_step_px = 1;  // and per row, > 0
  int columns = 0;
  int rows = 0;
  bool mirrored = false;  // its columns run from the picture's right to its left

  // The picture's point under a patch pixel, counted from 0; parts of pixels are allowed.
  [[nodiscard]] ImagePoint picture_point(double column, double row) const noexcept {
    const double across_px = (column - 0.5 * (columns - 1)) * step_px;
    return {middle.u_px + (mirrored ? -across_px : across_px), middle.v_px + (row - 0.5 * (rows - 1)) * row_step_px};
  }
};

// Writes rows by columns by 3 values, blue, green, red from -1 dark to 1 bright, each interpolated between the four
// pixels about it; beyond the picture its outermost pixels go on. `bgr` is CV_8UC3. Allocates nothing.
void sample_patch(const cv::Mat& bgr, const PatchPlace& place, float* values);

}  // namespace telehug
