// SPDX-License-Identifier: Apache-2.0
//
// Where in the camera's picture the screen's bottom edge should be, so that a person can turn the camera: the green
// band of the set-up page.
#pragma once

#include "calibration/border_line.hpp"
#include "common/units.hpp"

namespace telehug {

// Rows of the picture as the camera delivers it, top_px < bottom_px.
struct BorderBand {
  double top_px = 0;
  double bottom_px = 0;
};

// From where the strip in front of the edge fits into the picture that fingers come from (rows_needed.hpp), to where a
// usual camera (usual_rigs()) still sees the lower half of the screen. In pictures that are upside down, from the other
// end.
[[nodiscard]] BorderBand green_band(const ScreenSize& screen, ImageSize image, bool upside_down);

enum class CameraTurn {
  none,
  towards_screen,  // the edge is too far to the screen's side of the picture: little of the screen is seen
  towards_user,    // too little of what lies in front of the edge is seen
  level,           // it is rolled by more than largest_roll_deg
};

inline constexpr double largest_roll_deg = 4;  // the nets learned from rigs up to there

// `line` in the same rows as the band.
[[nodiscard]] double roll_deg(const BorderLine& line) noexcept;
[[nodiscard]] CameraTurn turn_wanted(const BorderLine& line, const BorderBand& band, ImageSize image,
                                     bool upside_down) noexcept;

}  // namespace telehug
