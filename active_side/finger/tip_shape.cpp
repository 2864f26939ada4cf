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
constexpr double settled_px = 0.02;  // a smaller step ends the fit
constexpr double local_share = 0.7;  // of how far the outline's own points at the tip lie beside the ellipse

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

// Centre (u, v), half width, half length, and angle (turned so that the tip moves to the right).
class Ellipse {
 public:
  explicit Ellipse(const Vector5& parameters) : p(parameters), sine_(std::sin(p[4])), cosine_(std::cos(p[4])) {}

  const Vector5 p;

  // Farther towards the tip than where a finger has straight sides.
  [[nodiscard]] bool is_at_tip(const ImagePoint& point) const { return local(point).y >= behind * p[3]; }

  struct Distance {
    double px;
    Vector5 gradient;  // by the parameters
  };
  // Signed, of first order (Sampson 1982), > 0 outside: with f = |(x / a, y / b)| it is (f - 1) / |grad f|, and
  // |grad f| = g / f, g = |(x / a^2, y / b^2)|.
  [[nodiscard]] Distance distance(const ImagePoint& point) const {
    const auto [x, y] = local(point);
    const double gx = x / (p[2] * p[2]);
    const double gy = y / (p[3] * p[3]);
    const double f = std::max(std::sqrt(x * gx + y * gy), 1e-6);
    const double g = std::max(std::sqrt(gx * gx + gy * gy), 1e-9);
    const double px = (f - 1) * f / g;
    // d px = by_f df + by_g dg; moving the ellipse moves the point the other way.
    const double by_f = (2 * f - 1) / g;
    const double by_g = -px / g;
    const double f_by_x = gx / f;
    const double f_by_y = gy / f;
    const double g_by_x = gx / (g * p[2] * p[2]);
    const double g_by_y = gy / (g * p[3] * p[3]);
    const double by_x = by_f * f_by_x + by_g * g_by_x;
    const double by_y = by_f * f_by_y + by_g * g_by_y;
    const double by_a = -(by_f * f_by_x + 2 * by_g * g_by_x) * x / p[2];
    const double by_b = -(by_f * f_by_y + 2 * by_g * g_by_y) * y / p[3];
    return {px, {-by_x * cosine_ - by_y * sine_, by_x * sine_ - by_y * cosine_, by_a, by_b, by_y * x - by_x * y}};
  }

  // Where v - slope u is largest.
  [[nodiscard]] ImagePoint foremost(double slope) const {
    const double x_along = -slope * cosine_ - sine_;
    const double y_along = -slope * sine_ + cosine_;
    const double norm = std::hypot(p[2] * x_along, p[3] * y_along);
    const double x = p[2] * p[2] * x_along / norm;
    const double y = p[3] * p[3] * y_along / norm;
    return {p[0] + x * cosine_ + y * sine_, p[1] - x * sine_ + y * cosine_};
  }

 private:
  struct Local {
    double x;
    double y;
  };
  [[nodiscard]] Local local(const ImagePoint& point) const {
    const double du = point.u_px - p[0];
    const double dv = point.v_px - p[1];
    return {du * cosine_ - dv * sine_, du * sine_ + dv * cosine_};
  }

  double sine_;
  double cosine_;
};

// From the contour's foremost points.
Vector5 first_guess(const TipContour& contour, double half_width_px) {
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
  return {0.5 * (left + right), farthest_v - half_width_px, 0.5 * (right - left), half_width_px, 0};
}

// The loss is wide at first, so that a poor beginning does not lose the right points.
double loss_scale(int round) {
  return inlier_px * (round < 4 ? 4 : round < 8 ? 2 : 1);
}

// Gauss-Newton with weights that fall off for points beside the ellipse (Geman and McClure 1985).
Ellipse fitted(const TipContour& contour, double half_width_px) {
  const double a0 = half_width_px;
  const Vector5 usual = first_guess(contour, a0);
  const Vector5 spread{0.5 * a0, 0.6 * a0, 0.25 * a0, 0.5 * a0, 0.35};
  const Vector5 largest_step{0.3 * a0, 0.3 * a0, 0.3 * a0, 0.3 * a0, 0.15};
  const Vector5 prior = inlier_px * inlier_px * spread.cwiseAbs2().cwiseInverse();
  Vector5 p = usual;
  for (int round = 0; round < rounds; ++round) {
    const double scale = loss_scale(round);
    const Ellipse ellipse(p);
    Matrix5 normal = prior.asDiagonal();
    Vector5 right_side = prior.cwiseProduct(usual - p);
    for (std::size_t i = 0; i < TipContour::angles; ++i) {
      if (!ellipse.is_at_tip(contour.points[i])) continue;
      const auto [residual, gradient] = ellipse.distance(contour.points[i]);
      const double z = residual / scale;
      const double weight = (0.1 + static_cast<double>(contour.edge[i])) / ((1 + z * z) * (1 + z * z));
      normal.noalias() += weight * gradient * gradient.transpose();
      right_side -= weight * residual * gradient;
    }
    const Vector5 step = normal.ldlt().solve(right_side).cwiseMin(largest_step).cwiseMax(-largest_step);
    p += step;
    p[2] = std::clamp(p[2], 0.4 * a0, 1.6 * a0);
    p[3] = std::clamp(p[3], 0.4 * a0, 3 * a0);
    p[4] = std::clamp(p[4], -0.8, 0.8);
    const bool settled = step.head<4>().cwiseAbs().maxCoeff() < settled_px && std::abs(step[4]) * a0 < settled_px;
    if (settled && scale <= inlier_px) break;
  }
  return Ellipse(p);
}

}  // namespace

TipShape fit_tip_shape(const TipContour& contour, double half_width_px, double slope) {
  const Ellipse ellipse = fitted(contour, half_width_px);
  TipShape shape{ellipse.foremost(slope), ellipse.p[2], ellipse.p[3], 0};
  double inliers = 0;
  double counted = 0;
  double local = 0;
  double local_sum = 0;
  for (const ImagePoint& point : contour.points) {
    if (!ellipse.is_at_tip(point)) continue;
    const double residual = ellipse.distance(point).px;
    const bool inlier = std::abs(residual) < within_px;
    counted += 1;
    inliers += inlier ? 1 : 0;
    if (inlier && std::abs(point.u_px - shape.tip.u_px) < 0.35 * half_width_px) {
      local += 1;
      local_sum += residual;
    }
  }
  if (local >= 2) shape.tip.v_px += local_share * local_sum / local;
  shape.inlier_share = counted > 0 ? inliers / counted : 0;
  return shape;
}

}  // namespace telehug
