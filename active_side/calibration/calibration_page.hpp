// SPDX-License-Identifier: Apache-2.0
//
// What a calibration shows on the screen: a triangle, and white dots on a black page.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/units.hpp"

namespace telehug {

inline constexpr double calibration_dot_mm = 10;  // diameter

// The corners of the black triangle on a white page, in parts of the screen's width and height from its top left. The
// first one is on the middle of the bottom edge.
struct PartOfScreen {
  double x = 0;
  double y = 0;
};
inline constexpr std::array calibration_triangle{PartOfScreen{0.5, 1}, PartOfScreen{0.25, 1.0 / 3},
                                                 PartOfScreen{0.75, 1.0 / 3}};

// Where the dots lie on the page of marks, which is shown with nobody there: in rows from one side of the screen to the
// other, on its lower half, which the camera sees best. It never sees all of them. Columns lie 60 mm apart, so that a
// camera that is known to 20 mm tells which is which.
[[nodiscard]] inline std::vector<ScreenPoint> mark_points(const ScreenSize& screen) {
  constexpr double apart_mm = 60;
  const int columns = std::clamp(static_cast<int>(std::lround(screen.width_mm / apart_mm)), 5, 12);
  std::vector<ScreenPoint> points;
  for (const double y : {0.5, 0.7, 0.9}) {
    for (int column = 0; column < columns; ++column)
      points.push_back({(column + 0.5) / columns * screen.width_mm, y * screen.height_mm});
  }
  return points;
}

}  // namespace telehug
