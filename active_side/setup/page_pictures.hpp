// SPDX-License-Identifier: Apache-2.0
//
// The pictures that a set-up shows on the whole screen.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/units.hpp"

namespace telehug {

// CV_8UC3 of the screen's pixels; 4 a mm if these are not known.
// Black on white, one vertex in the middle of the bottom edge: it tells the screen's own edge from the bezel's others.
[[nodiscard]] cv::Mat triangle_picture(const ScreenSize& screen);

// White dots of calibration_dot_mm on black, exact to a sixteenth of a pixel: the camera sees where they are to less
// than half of one. No points: all black.
[[nodiscard]] cv::Mat dots_picture(const ScreenSize& screen, const std::vector<ScreenPoint>& points);

}  // namespace telehug
