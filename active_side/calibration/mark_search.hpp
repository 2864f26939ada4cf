// SPDX-License-Identifier: Apache-2.0
//
// The page of marks (calibration_page.hpp) in the webcam's picture. Runs once a calibration.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "calibration/rig_camera.hpp"
#include "calibration/rig_observations.hpp"
#include "common/units.hpp"

namespace telehug {

// The middles of what is lit in `shown` and is not in `empty`, both CV_8UC3 and of one size. What the picture's edge
// may cut is left out.
[[nodiscard]] std::vector<ImagePoint> lit_spots(const cv::Mat& shown, const cv::Mat& empty);

// The marks near whose expected place a spot lies, as points of the screen, to about a pixel. `camera` may be wrong by
// a third of the marks' distance from each other. A mark that contradicts the others is left out; fewer than five that
// agree are none, for they would not tell the camera.
[[nodiscard]] std::vector<PointObservation> marks_at(const std::vector<ImagePoint>& spots, const ScreenSize& screen,
                                                     const RigCamera& camera);

// The same marks as exactly as dots are measured, without those that do not look like dots.
[[nodiscard]] std::vector<PointObservation> measured_marks(const cv::Mat& shown,
                                                           const std::vector<PointObservation>& marks,
                                                           const ScreenSize& screen, const RigCamera& camera);

}  // namespace telehug
