// SPDX-License-Identifier: Apache-2.0
//
// The white dot that a calibration shows on a black screen, found in the webcam's picture, with or without a finger on
// it.
//
// The finger hides a part of the dot, and the dot's light floods the fingertip, so that the tip's outline is of no use
// there. But the camera sees the arc nearest to itself and both ends of the dot, and where the dot is on the screen is
// known exactly: a flat mark without the unknowns of a finger.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "calibration/border_line.hpp"
#include "calibration/calibration_page.hpp"
#include "calibration/rig_camera.hpp"
#include "common/units.hpp"

namespace telehug {

struct CalibrationDot {
  ImagePoint centre;  // the image of the dot's centre; the middle of its outline lies elsewhere, by parts of a pixel
  double sigma_u_px = 0;
  double sigma_v_px = 0;
  double score = 0;  // share of the outline that should be visible and is, 0 to 1
};

// The dot anywhere on the screen, that is below `border` (greater v; the line may be wrong by some pixels). Webcams on
// top of monitors are assumed (usual_rigs()). Nothing if there is none: the screen must be black around it.
// `bgr` is CV_8UC3 of any size. Takes some 10 ms; runs once a picture of a calibration.
std::optional<CalibrationDot> find_calibration_dot(const cv::Mat& bgr, const BorderLine& border,
                                                   double diameter_mm = calibration_dot_mm);

// The same within some pixels of `near`, more exactly, when the camera is known: then so is the shape of the dot's
// outline. `camera` must be for pictures of this size.
std::optional<CalibrationDot> refine_calibration_dot(const cv::Mat& bgr, const RigCamera& camera,
                                                     const ImagePoint& near, double diameter_mm = calibration_dot_mm);

}  // namespace telehug
