// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace telehug {

// The image of the screen's bottom edge, v = v0_px + slope * u_px (as calibration/border_line.hpp has it): the desk and
// the user's hand lie above it in the picture (smaller v).
struct BorderPlace {
  double v0_px = 0;
  double slope = 0;
};

}  // namespace telehug
