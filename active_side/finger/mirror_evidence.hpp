// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "finger/finger_outline.hpp"
#include "finger/mirror_state.hpp"

namespace telehug {

// How the screen's normal looks at a fingertip: what lies further from the screen is seen further along this line.
struct ScreenNormal {
  double u_per_v = 0;    // its slope; 0: straight up, as without roll
  double px_per_mm = 0;  // length of a millimetre, > 0; about f / (y - y0)
};

// Whether a finger touches the screen, from its mirror image in this one picture. A point z in front of the screen and
// its mirror image z behind it lie on one image of the screen's normal, equally far from their foot. So the mirror
// image of a touching finger begins at its tip, and that of a finger hovering h before the screen 2 h px_per_mm below.
//
// Silent on screens that don't mirror visibly (matt, bright) and while the mirror image lies outside the picture: no
// mirror image is no evidence. `bgr` is CV_8UC3. Allocates nothing.
MirrorEvidence mirror_evidence(const cv::Mat& bgr, const FingerOutline& finger, const ScreenNormal& normal);

}  // namespace telehug
