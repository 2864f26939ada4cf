// SPDX-License-Identifier: Apache-2.0
//
// The rig's camera before anybody has touched the screen: from the triangle, the screen's bottom edge and the page of
// marks. It tells which part of the screen the camera sees, and how far a finger is from where it should touch.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/screen_border.hpp"

namespace telehug {

// What a set-up has seen with nobody there. Pictures are CV_8UC3 and of one size, the screen below its border.
struct EmptyScreenPictures {
  ScreenSize screen;
  ScreenBorder border;  // only its vertex is used, if there is one
  cv::Mat black;
  cv::Mat marks;
};

// The cameras that see the marks where they are, the likeliest first; none without five marks that one usual camera
// sees: the page is not shown, or not on the whole screen. Marks lie as much to the left as to the right, so they can't
// tell whether pictures are mirrored: `left_right_exchanged` must be known or tried. Without the triangle's vertex
// nothing tells one column of marks from the next one, and up to three cameras are found: a dot elsewhere decides.
[[nodiscard]] std::vector<RigCalibration> cameras_from_marks(const EmptyScreenPictures& seen,
                                                             bool left_right_exchanged);

// A camera of the usual kind that sees the border and the triangle's vertex where they are; some 20 % inexact.
[[nodiscard]] RigModel likely_camera(const ScreenBorder& border, const ScreenSize& screen, ImageSize image,
                                     bool left_right_exchanged);

// The model as a calibration of these (upright) pictures, for the detector.
[[nodiscard]] Calibration as_calibration(const RigModel& model, const ScreenSize& screen);

}  // namespace telehug
