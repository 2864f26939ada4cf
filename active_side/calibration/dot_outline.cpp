// SPDX-License-Identifier: Apache-2.0
#include "calibration/dot_outline.hpp"

#include <cmath>
#include <numbers>

namespace telehug {

std::optional<DotOutline> dot_outline(const RigCamera& camera, const ImagePoint& centre, double diameter_mm) noexcept {
  const auto on_screen = camera.screen_point(centre);
  if (!on_screen) return std::nullopt;
  DotOutline outline;
  for (std::size_t i = 0; i < DotOutline::count; ++i) {
    const double t = 2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / DotOutline::count;
    DotOutline::Point& point = outline.points[i];
    point.cosine = std::cos(t);
    point.sine = std::sin(t);
    const auto image = camera.project(
        ScreenPoint{on_screen->x_mm + diameter_mm / 2 * point.cosine, on_screen->y_mm + diameter_mm / 2 * point.sine});
    if (!image) return std::nullopt;
    point.image = *image;
  }
  for (std::size_t i = 0; i < DotOutline::count; ++i) {
    DotOutline::Point& point = outline.points[i];
    const ImagePoint& before = outline.points[(i + DotOutline::count - 1) % DotOutline::count].image;
    const ImagePoint& after = outline.points[(i + 1) % DotOutline::count].image;
    double u = after.v_px - before.v_px;
    double v = before.u_px - after.u_px;
    const double length = std::hypot(u, v);
    if (!(length > 0)) return std::nullopt;
    const bool inwards = u * (point.image.u_px - centre.u_px) + v * (point.image.v_px - centre.v_px) < 0;
    const double scale = (inwards ? -1 : 1) / length;
    point.normal_u = u * scale;
    point.normal_v = v * scale;
  }
  return outline;
}

}  // namespace telehug
