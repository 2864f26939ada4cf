// SPDX-License-Identifier: Apache-2.0
//
// Touches of the white dots that a calibration shows, one a picture on a black screen, as the dots themselves tell
// where they are.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "calibration/border_choice.hpp"
#include "calibration/calibration_dot.hpp"
#include "calibration/rig_observations.hpp"
#include "common/result.hpp"

namespace telehug {

struct DotPicture {
  cv::Mat bgr;  // CV_8UC3
  ScreenPoint screen;
  std::optional<CalibrationDot> dot;
};

// Looks for the dot in each picture, see find_calibration_dot(). A calibration shows its dots in all pictures or in
// none (a person who touches marks on paper, say): if less than half of the pictures have one, nothing is what it
// seems, and all are left without.
void find_dots(std::vector<DotPicture>& pictures, const BorderLine& border);

// The pictures that have a dot, as touches; the others are left out: the light of a dot that was not found floods the
// fingertip all the same.
[[nodiscard]] std::vector<PointObservation> dot_touches(const std::vector<DotPicture>& pictures);

// solve_with_border() with the dots of the pictures as touches. The camera that it finds tells the exact shape of the
// dots' outlines, with which they are measured again, in `pictures` too.
Result<BorderChosen> solve_with_dots(RigObservations observations, std::vector<DotPicture>& pictures,
                                     const std::vector<BorderCandidate>& candidates);

}  // namespace telehug
