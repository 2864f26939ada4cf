// SPDX-License-Identifier: Apache-2.0
//
// A rig's calibration from pictures: of an empty screen, and of a finger on a white dot, one dot a picture.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "calibration/calibration.hpp"
#include "common/result.hpp"

namespace telehug {

// All are CV_8UC3 and of one size.
struct CalibrationPictures {
  struct Touch {
    cv::Mat bgr;
    ScreenPoint screen;  // the dot's centre
  };

  ScreenSize screen;
  cv::Mat empty;                    // nobody there, black screen
  std::optional<cv::Mat> triangle;  // nobody there, see BorderChoice::triangle
  std::optional<cv::Mat> marks;     // nobody there, mark_points() on a black screen
  std::vector<Touch> touches;       // a finger on a white dot of calibration_dot_mm, black around it
};

// Where the dots are seen tells where the camera is; where a dot is hidden by its finger, cut by the picture's edge, or
// looks like something else, the finger's contact does, less exactly. Marks are found from there, and make up for few
// touches. Touches that contradict the marks, or without these the other touches, are marked as left out; marks that
// contradict most touches are not used; without marks the screen's bottom edge helps if it agrees with the touches. The
// observations hold what was seen, in the pictures' order; whether it suffices is what judge_calibration() says. The
// error says how many touches were seen, if too few.
Result<RigCalibration> calibrate_with_pictures(const CalibrationPictures& pictures);

}  // namespace telehug
