// SPDX-License-Identifier: Apache-2.0
#include "calibration/rig_residuals.hpp"

#include <cmath>

namespace telehug {
namespace {

std::optional<ImagePoint> difference(const std::optional<ImagePoint>& expected, const ImagePoint& seen) {
  if (!expected) return std::nullopt;
  return ImagePoint{expected->u_px - seen.u_px, expected->v_px - seen.v_px};
}

}  // namespace

std::optional<ImagePoint> touch_residual(const RigModel& model, const PointObservation& touch) {
  if (touch.evidence != TouchEvidence::fingertip) return mark_residual(model, touch);
  return difference(tip_of_contact(model.camera, model.contact_radius_mm, touch.screen), touch.image);
}

std::optional<ScreenPoint> touched_point(const RigModel& model, const PointObservation& touch) {
  if (touch.evidence != TouchEvidence::fingertip) return model.camera.screen_point(touch.image);
  return model.screen_point(touch.image);
}

std::optional<ImagePoint> mark_residual(const RigModel& model, const PointObservation& mark) {
  return difference(model.camera.project(mark.screen), mark.image);
}

std::optional<double> border_residual(const RigModel& model, double screen_height_mm, const BorderObservation& border) {
  const auto row = border_row(model.camera, screen_height_mm, border.image.u_px);
  if (!row) return std::nullopt;
  return *row - border.image.v_px;
}

// The edge's images of two points 1 mm apart give dx / du; a few secant steps along the edge end near the column, since
// the edge is nearly straight and level in the picture. Its tangent leads from there to the column itself: lenses bend
// the edge by less than 1e-4 per px, which over near_px makes 1e-8 px.
std::optional<double> border_row(const RigCamera& camera, double screen_height_mm, double u_px) {
  constexpr double near_px = 0.01;
  double x = camera.position_mm().x_mm;
  for (int i = 0; i < 20; ++i) {
    const auto here = camera.project(ScreenPoint{x, screen_height_mm});
    const auto beside = camera.project(ScreenPoint{x + 1, screen_height_mm});
    if (!here || !beside) return std::nullopt;
    const double px_per_mm = beside->u_px - here->u_px;
    const double off_px = u_px - here->u_px;
    if (std::abs(off_px) < near_px) return here->v_px + off_px / px_per_mm * (beside->v_px - here->v_px);
    x += off_px / px_per_mm;
    if (!std::isfinite(x)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace telehug
