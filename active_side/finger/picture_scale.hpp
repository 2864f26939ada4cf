// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/border_curve.hpp"
#include "calibration/rig_camera.hpp"

namespace telehug {

// Pixels of the picture per mm of the screen's x at the foot of a pixel's ray; nothing where it meets no screen.
inline std::optional<double> px_per_mm_at(const RigCamera& camera, const ImagePoint& place) noexcept {
  const auto foot = camera.screen_point(place);
  if (!foot) return std::nullopt;
  const auto beside = camera.project(ScreenPoint{foot->x_mm + 1, foot->y_mm});
  if (!beside) return std::nullopt;
  return std::hypot(beside->u_px - place.u_px, beside->v_px - place.v_px);
}

// The same, or where no camera is known, that of a usual rig at its bottom edge. Never so small or large that nothing
// could be seen.
inline double px_per_mm_at(const std::optional<RigCamera>& camera, ImageSize image, const ImagePoint& place) noexcept {
  constexpr double usual_px_per_mm = 3.3;  // in pictures of 1280 columns
  const auto measured = camera ? px_per_mm_at(*camera, place) : std::nullopt;
  return std::clamp(measured.value_or(usual_px_per_mm * image.width_px / 1280), 0.5, 50.0);
}

// In the middle of the screen's bottom edge.
inline double px_per_mm_at_border(const std::optional<RigCamera>& camera, const BorderCurve& border, ImageSize image) {
  const double u = image.width_px / 2.0;
  return px_per_mm_at(camera, image, {u, border.v_at(u)});
}

}  // namespace telehug
