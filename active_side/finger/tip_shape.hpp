// SPDX-License-Identifier: Apache-2.0
//
// From a fingertip's outline to its foremost point. Outlines cut a corner at the edge of a nail, or follow a contact's
// shadow onto the glass; most of their points are right. An ellipse fitted to the tip with a loss that lets go of
// points beside it says where the outline goes on, and so does better than the outline's own extreme.
#pragma once

#include "finger/tip_contour.hpp"

namespace telehug {

struct TipShape {
  ImagePoint tip;            // foremost across the border
  double half_width_px = 0;  // of the ellipse
  double half_length_px = 0;
  double inlier_share = 0;  // of the outline's points within 2 px of the ellipse, 0 to 1
};

// `half_width_px` is what the finger's sides say; `slope` is how the screen's horizontal runs in the picture there
// (rows per column): the foremost point is the farthest perpendicularly to it.
[[nodiscard]] TipShape fit_tip_shape(const TipContour& contour, double half_width_px, double slope);

}  // namespace telehug
