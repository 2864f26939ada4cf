// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace telehug {

// The image of the screen's bottom edge: v = v0_px + slope * u, in the image frame, u from the picture's left edge.
// The screen lies below it in the picture (greater v), the desk and the user's hand above.
struct BorderLine {
  double v0_px = 0;
  double slope = 0;  // tangent of the camera's roll; 0: the border is a row of pixels

  [[nodiscard]] constexpr double v_at(double u_px) const noexcept { return v0_px + slope * u_px; }
};

}  // namespace telehug
