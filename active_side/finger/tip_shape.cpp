// SPDX-License-Identifier: Apache-2.0
#include "finger/tip_shape.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace telehug {
namespace {

constexpr double inlier_px = 1.2;  // scale of the loss at the end
constexpr double within_px = 2;    // counted as inliers
constexpr double behind = -0.15;   // of the half length: farther back a finger has straight sides
constexpr int rounds = 14;
constexpr double local_share = 0.7;  // of how far the outline's own points at the tip lie beside the ellipse

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

// Centre (u, v), half width, half length, and angle (turned so that the tip moves to the right).
struct Ellipse {
  Vector5 p;

  struct Local {
    double x;
    double y;
  };
  [[nodiscard]] Local local(const ImagePoint& point) const {
    const double s = std::sin(p[4]);
    const double c = std::cos(p[4]);
    const double du = point.u_px - p[0];
    const double dv = point.v_px - p[1];
    return {du * c - dv * s, du * s + dv * c};
  }
  // Signed distance of first order (Sampson 1982); > 0 outside.
  [[nodiscard]] double distance(const ImagePoint& point) const {
    const auto [x, y] = local(point);
    const double fx = x / p[2];
    const double fy = y / p[3];
    const double f = std::max(std::hypot(fx, fy), 1e-6);
    return (f - 1) / std::max(std::hypot(fx / p[2], fy / p[3]) / f, 1e-9);
  }
};

}  // namespace

TipShape fit_tip_shape(const TipContour& contour, double half_width_px, double slope) {
  double farthest_v = -std::numeric_limits<double>::max();
  for (const ImagePoint& point : contour.points)
    farthest_v = std::max(farthest_v, point.v_px);
  double left = std::numeric_limits<double>::max();
  double right = -left;
  for (const ImagePoint& point : contour.points) {
    if (point.v_px < farthest_v - 1.2 * half_width_px) continue;
    left = std::min(left, point.u_px);
    right = std::max(right, point.u_px);
  }
  const double a0 = half_width_px;
  Ellipse ellipse{Vector5{0.5 * (left + right), farthest_v - a0, 0.5 * (right - left), a0, 0}};
  const Vector5 usual = ellipse.p;
  const Vector5 spread{0.5 * a0, 0.6 * a0, 0.25 * a0, 0.5 * a0, 0.35};
  const Vector5 largest_step{0.3 * a0, 0.3 * a0, 0.3 * a0, 0.3 * a0, 0.15};

  for (int round = 0; round < rounds; ++round) {
    // The loss is wide at first, so that a poor beginning does not lose the right points.
    const double scale = inlier_px * (round < 4 ? 4 : round < 8 ? 2 : 1);
    Matrix5 normal = Matrix5::Zero();
    Vector5 right_side = Vector5::Zero();
    for (std::size_t i = 0; i < TipContour::angles; ++i) {
      const ImagePoint& point = contour.points[i];
      if (ellipse.local(point).y < behind * ellipse.p[3]) continue;
      const double residual = ellipse.distance(point);
      Vector5 gradient;
      for (int k = 0; k < 5; ++k) {
        const double h = k == 4 ? 1e-3 : 0.05;
        Ellipse moved = ellipse;
        moved.p[k] += h;
        gradient[k] = (moved.distance(point) - residual) / h;
      }
      const double z = residual / scale;
      const double weight = (0.1 + static_cast<double>(contour.edge[i])) / ((1 + z * z) * (1 + z * z));
      normal += weight * gradient * gradient.transpose();
      right_side -= weight * residual * gradient;
    }
    for (int k = 0; k < 5; ++k) {
      const double weight = inlier_px * inlier_px / (spread[k] * spread[k]);
      normal(k, k) += weight;
      right_side[k] += weight * (usual[k] - ellipse.p[k]);
    }
    const Vector5 step = normal.ldlt().solve(right_side);
    ellipse.p += step.cwiseMin(largest_step).cwiseMax(-largest_step);
    ellipse.p[2] = std::clamp(ellipse.p[2], 0.4 * a0, 1.6 * a0);
    ellipse.p[3] = std::clamp(ellipse.p[3], 0.4 * a0, 3 * a0);
    ellipse.p[4] = std::clamp(ellipse.p[4], -0.8, 0.8);
  }

  // The point of the ellipse where v - slope u is largest.
  const double s = std::sin(ellipse.p[4]);
  const double c = std::cos(ellipse.p[4]);
  const double x_along = -slope * c - s;
  const double y_along = -slope * s + c;
  const double a = ellipse.p[2];
  const double b = ellipse.p[3];
  const double norm = std::hypot(a * x_along, b * y_along);
  const double x = a * a * x_along / norm;
  const double y = b * b * y_along / norm;
  TipShape shape{{ellipse.p[0] + x * c + y * s, ellipse.p[1] - x * s + y * c}, a, b, 0};

  double inliers = 0;
  double counted = 0;
  double local = 0;
  double local_sum = 0;
  for (const ImagePoint& point : contour.points) {
    if (ellipse.local(point).y < behind * b) continue;
    const double residual = ellipse.distance(point);
    const bool inlier = std::abs(residual) < within_px;
    counted += 1;
    inliers += inlier ? 1 : 0;
    if (inlier && std::abs(point.u_px - shape.tip.u_px) < 0.35 * a0) {
      local += 1;
      local_sum += residual;
    }
  }
  if (local >= 2) shape.tip.v_px += local_share * local_sum / local;
  shape.inlier_share = counted > 0 ? inliers / counted : 0;
  return shape;
}

}  // namespace telehug
