// SPDX-License-Identifier: Apache-2.0
//
// The touch model written for a camera above the screen's top: e is its height above it, and all heights are distances
// below the top as before. Independent of the product's code, for a cross-check: with e = -d both must agree.
#pragma once

#include "calibration/thesis_touch_model.hpp"
#include "common/units.hpp"

namespace telehug {

struct MirroredEquations {
  double m_h;
  MeasuredTouch first;
  MeasuredTouch second;

  // From l1 (h1 + e) / (m_h - h1) = l2 (h2 + e) / (m_h - h2): both sides are K / (m_h + e).
  [[nodiscard]] double camera_above_top_mm() const {
    const double a1 = first.length_px / (m_h - first.screen.y_mm);
    const double a2 = second.length_px / (m_h - second.screen.y_mm);
    return (a2 * second.screen.y_mm - a1 * first.screen.y_mm) / (a1 - a2);
  }

  [[nodiscard]] ScreenPoint screen_point(double length_px, double column_px) const {
    const double e = camera_above_top_mm();
    const double k_over_border = first.length_px * (first.screen.y_mm + e) / (m_h - first.screen.y_mm);
    // l = k (m_h - y) / (y + e), solved for y.
    const double y_mm = (k_over_border * m_h - length_px * e) / (length_px + k_over_border);
    // Columns times distances below the camera are in proportion to distances beside the camera.
    const double s1 = first.column_px * (first.screen.y_mm + e);
    const double s2 = second.column_px * (second.screen.y_mm + e);
    const double px_per_mm = (s2 - s1) / (second.screen.x_mm - first.screen.x_mm);
    return {first.screen.x_mm + (column_px * (y_mm + e) - s1) / px_per_mm, y_mm};
  }
};

}  // namespace telehug
