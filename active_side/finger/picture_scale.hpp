// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

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

}  // namespace telehug
