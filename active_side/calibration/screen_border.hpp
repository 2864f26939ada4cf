// SPDX-License-Identifier: Apache-2.0
//
// Finds the image of the screen's bottom edge the way the thesis does: erosion, dilation, smoothing; straight lines by
// the Hough transform; nearly horizontal ones merged by their level. Runs once a calibration, not per frame.
//
// Numbers that the thesis does not give, chosen here: a line is nearly horizontal within 6 degrees (cameras are
// off by up to 4, facts/touch.md); pieces belong to one line within 4 px, because lens distortion bends the
// border by a few px while the two edges of a bezel are 15 px and more apart.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "calibration/border_line.hpp"
#include "calibration/rig_observations.hpp"
#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

// Nearly horizontal pieces of edges that lie on one line.
struct LevelLine {
  BorderLine line;
  double length_px = 0;  // columns that the pieces cover; where they overlap, counted once
};

enum class BorderChoice {
  triangle,        // the picture shows a black triangle with one vertex on the screen's bottom edge: it picks the line
  triangle_alone,  // where the triangle's edges meet, if below them it is darker: of dim screens in light bezels no
                   // line is found there. The line goes through the vertex, as level as the longest one; its length is
                   // 0
  longest,         // no triangle: the longest line, the lowest of those equally long. May be another edge than the
                   // screen's own: in one sample it is the bezel's mirror image, 9 px below
};

struct ScreenBorder {
  BorderLine line;
  double length_px = 0;
  std::optional<ImagePoint> vertex;  // of the triangle, if it picked the line
};

// The triangle's vertex as a point of the screen: in the middle of its bottom edge. Nothing without a triangle.
std::optional<PointObservation> triangle_mark(const ScreenBorder& border, const ScreenSize& screen);

// `bgr` is CV_8UC3. The error says what was not found and what to do.
Result<ScreenBorder> find_screen_border(const cv::Mat& bgr, BorderChoice choice);

// All candidates, the longest first; for pages that let a person pick.
std::vector<LevelLine> find_level_lines(const cv::Mat& bgr);

}  // namespace telehug
