// SPDX-License-Identifier: Apache-2.0
#include "calibration/border_curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>

namespace telehug {

BorderCurve::BorderCurve(const BorderLine& line, ImageSize image) {
  for (int u = 0; u < image.width_px; ++u)
    v_px_.push_back(line.v_at(u));
}

BorderCurve::BorderCurve(const RigCamera& camera, const ScreenSize& screen) {
  constexpr double beyond = 0.5;  // of the screen's width, on either side
  constexpr int pieces = 400;
  std::vector<ImagePoint> points;
  for (int i = 0; i <= pieces; ++i) {
    const double x_mm = screen.width_mm * ((1 + 2 * beyond) * i / pieces - beyond);
    if (const auto point = camera.project(ScreenPoint{x_mm, screen.height_mm})) points.push_back(*point);
  }
  if (points.size() < 2) throw std::invalid_argument("the camera does not see the screen's bottom edge");
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.u_px < b.u_px; });
  std::size_t next = 1;
  for (int u = 0; u < camera.image().width_px; ++u) {
    while (next + 1 < points.size() && points[next].u_px < u)
      ++next;
    const ImagePoint& a = points[next - 1];
    const ImagePoint& b = points[next];
    const double du = std::max(b.u_px - a.u_px, 1e-6);
    v_px_.push_back(a.v_px + (b.v_px - a.v_px) * (u - a.u_px) / du);
  }
}

double BorderCurve::v_at(double u_px) const noexcept {
  const double last = static_cast<double>(v_px_.size()) - 1;
  return v_px_[static_cast<std::size_t>(std::lround(std::clamp(u_px, 0.0, last)))];
}

double BorderCurve::slope_at(double u_px) const noexcept {
  constexpr double reach_px = 8;
  const double last = static_cast<double>(v_px_.size()) - 1;
  const double left = std::clamp(u_px - reach_px, 0.0, std::max(0.0, last - 2 * reach_px));
  const double right = std::min(left + 2 * reach_px, last);
  return right > left ? (v_at(right) - v_at(left)) / (right - left) : 0;
}

}  // namespace telehug
