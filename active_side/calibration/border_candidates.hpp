// SPDX-License-Identifier: Apache-2.0
//
// Edges in the picture that may be the screen's bottom edge, each followed as the curve that the lens makes of it and
// measured to parts of a pixel.
//
// A monitor shows several: the bezel's outer edge, its ridges, the screen's own edge, and on glossy screens their
// mirror images. On a black screen its own edge may be the faintest. So no edge is chosen here; the touches decide
// (solve_with_border()).
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "calibration/border_line.hpp"
#include "calibration/rig_observations.hpp"

namespace telehug {

struct BorderCandidate {
  std::vector<BorderObservation> points;  // rising columns
  bool brighter_below = false;
  double contrast = 0;  // grey levels per row, mean over the points
};

// The nearly parallel edges around `level`, a line that a level edge of the monitor follows (find_level_lines()), from
// the top of the picture to its bottom. `bgr` is CV_8UC3, a picture without hands. Runs once a calibration.
std::vector<BorderCandidate> find_border_candidates(const cv::Mat& bgr, const BorderLine& level);

}  // namespace telehug
