// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>

#include "common/units.hpp"

namespace telehug {

// A finger as a detector sees it before the screen: a centre line and half widths about it, both straight along v,
//   u = centre_u_px + centre_slope (v - reference_v_px)    half width = half_width_px + half_width_slope (v - ...)
// and the outline of its end.
struct FingerOutline {
  ImagePoint tip;  // foremost point, on the screen's side
  double reference_v_px = 0;
  double centre_u_px = 0;
  double centre_slope = 0;  // px per px
  double half_width_px = 0;
  double half_width_slope = 0;
  boost::container::static_vector<ImagePoint, 64> contour;  // of the finger's end, in any order; may be empty
};

}  // namespace telehug
