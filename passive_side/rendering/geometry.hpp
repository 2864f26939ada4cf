// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "common/units.hpp"

namespace telehug {

[[nodiscard]] inline bool finite(BodyPoint point) noexcept {
  return std::isfinite(point.x_fh) && std::isfinite(point.y_fh);
}

// No body is larger: what is farther away (and finite) counts as just there.
[[nodiscard]] inline BodyPoint on_a_body(BodyPoint place) noexcept {
  constexpr double farthest_fh = 100;
  return {std::clamp(place.x_fh, -farthest_fh, farthest_fh), std::clamp(place.y_fh, -farthest_fh, farthest_fh)};
}

[[nodiscard]] inline double distance_fh(BodyPoint a, BodyPoint b) noexcept {
  return std::hypot(a.x_fh - b.x_fh, a.y_fh - b.y_fh);
}

// part: 0 at `from`, 1 at `to`.
[[nodiscard]] inline BodyPoint point_between(BodyPoint from, BodyPoint to, double part) noexcept {
  return {from.x_fh + part * (to.x_fh - from.x_fh), from.y_fh + part * (to.y_fh - from.y_fh)};
}

// Which part of the way from..to is nearest to `point`: below 0 before its begin, above 1 behind its end; 0 if it has
// no length.
[[nodiscard]] inline double part_nearest(BodyPoint point, BodyPoint from, BodyPoint to) noexcept {
  const double dx = to.x_fh - from.x_fh;
  const double dy = to.y_fh - from.y_fh;
  const double length2 = dx * dx + dy * dy;
  return length2 > 0 ? ((point.x_fh - from.x_fh) * dx + (point.y_fh - from.y_fh) * dy) / length2 : 0;
}

// Twice the area of the triangle, positive where a, b, c turn from x towards y.
[[nodiscard]] inline double turn(BodyPoint a, BodyPoint b, BodyPoint c) noexcept {
  return (b.x_fh - a.x_fh) * (c.y_fh - a.y_fh) - (b.y_fh - a.y_fh) * (c.x_fh - a.x_fh);
}

}  // namespace telehug
