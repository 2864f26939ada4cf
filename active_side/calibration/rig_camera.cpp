// SPDX-License-Identifier: Apache-2.0
#include "calibration/rig_camera.hpp"

#include <cmath>
#include <numbers>

namespace telehug {
namespace {

using Matrix = std::array<double, 9>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      for (std::size_t i = 0; i < 3; ++i)
        result[3 * row + column] += a[3 * row + i] * b[3 * i + column];
    }
  }
  return result;
}

Matrix camera_of_rig(const RigCameraParameters& p) {
  constexpr double radians = std::numbers::pi / 180;
  const double cr = std::cos(p.roll_deg * radians), sr = std::sin(p.roll_deg * radians);
  const double cp = std::cos(p.pitch_deg * radians), sp = std::sin(p.pitch_deg * radians);
  const double cy = std::cos(p.yaw_deg * radians), sy = std::sin(p.yaw_deg * radians);
  // u = -x, v = -z, w = +y: the rig frame is left-handed, the camera frame is not.
  constexpr Matrix straight_down{-1, 0, 0, 0, 0, -1, 0, 1, 0};
  const Matrix yaw{cy, 0, -sy, 0, 1, 0, sy, 0, cy};
  const Matrix pitch{1, 0, 0, 0, cp, sp, 0, -sp, cp};
  const Matrix roll{cr, -sr, 0, sr, cr, 0, 0, 0, 1};
  return product(roll, product(pitch, product(yaw, straight_down)));
}

// r (1 + k1 r^2) rises up to here; beyond, two directions would share a pixel.
bool folds_over(double k1, double r_squared) {
  return 1 + 3 * k1 * r_squared <= 0;
}

// The r with r (1 + k1 r^2) = distorted, by Newton's method; from `distorted` it converges monotonically after the
// first step for both signs of k1.
std::optional<double> undistorted(double k1, double distorted) {
  double r = distorted;
  for (int i = 0; i < 50; ++i) {
    if (folds_over(k1, r * r)) return std::nullopt;
    const double step = (r * (1 + k1 * r * r) - distorted) / (1 + 3 * k1 * r * r);
    r -= step;
    if (std::abs(step) <= 1e-14 * (1 + std::abs(r))) return folds_over(k1, r * r) ? std::nullopt : std::optional(r);
  }
  return std::nullopt;
}

}  // namespace

const char* PictureOrientation::name() const noexcept {
  if (left_right_exchanged) return top_bottom_exchanged ? "upside down" : "mirrored";
  return top_bottom_exchanged ? "mirrored and upside down" : "upright";
}

RigCamera::RigCamera(const RigCameraParameters& parameters, ImageSize image, PictureOrientation orientation)
    : parameters_(parameters), image_(image), orientation_(orientation), camera_of_rig_(camera_of_rig(parameters)) {}

std::optional<ImagePoint> RigCamera::project(const RigVector& point) const noexcept {
  const auto& m = camera_of_rig_;
  const double x = point.x_mm - position_mm().x_mm;
  const double y = point.y_mm - position_mm().y_mm;
  const double z = point.z_mm - position_mm().z_mm;
  const double depth = m[6] * x + m[7] * y + m[8] * z;
  if (!(depth > 0)) return std::nullopt;
  double u = (m[0] * x + m[1] * y + m[2] * z) / depth;
  double v = (m[3] * x + m[4] * y + m[5] * z) / depth;
  const double r_squared = u * u + v * v;
  if (folds_over(parameters_.k1, r_squared)) return std::nullopt;
  const double scale = parameters_.focal_px * (1 + parameters_.k1 * r_squared);
  u *= orientation_.left_right_exchanged ? -scale : scale;
  v *= orientation_.top_bottom_exchanged ? -scale : scale;
  return ImagePoint{0.5 * (image_.width_px - 1) + u, 0.5 * (image_.height_px - 1) + v};
}

std::optional<ImagePoint> RigCamera::project(const ScreenPoint& point) const noexcept {
  return project(RigVector{point.x_mm, point.y_mm, 0});
}

std::optional<RigVector> RigCamera::ray(const ImagePoint& point) const noexcept {
  double u = (point.u_px - 0.5 * (image_.width_px - 1)) / parameters_.focal_px;
  double v = (point.v_px - 0.5 * (image_.height_px - 1)) / parameters_.focal_px;
  if (orientation_.left_right_exchanged) u = -u;
  if (orientation_.top_bottom_exchanged) v = -v;
  const double distorted = std::hypot(u, v);
  if (distorted > 0) {
    const auto r = undistorted(parameters_.k1, distorted);
    if (!r) return std::nullopt;
    u *= *r / distorted;
    v *= *r / distorted;
  }
  const auto& m = camera_of_rig_;
  return RigVector{m[0] * u + m[3] * v + m[6], m[1] * u + m[4] * v + m[7], m[2] * u + m[5] * v + m[8]};
}

std::optional<ScreenPoint> RigCamera::screen_point(const ImagePoint& point, double z_mm) const noexcept {
  const auto direction = ray(point);
  if (!direction || !(direction->z_mm < 0) || !(position_mm().z_mm > z_mm)) return std::nullopt;
  const double reach = (z_mm - position_mm().z_mm) / direction->z_mm;
  const ScreenPoint met{position_mm().x_mm + reach * direction->x_mm, position_mm().y_mm + reach * direction->y_mm};
  if (!std::isfinite(met.x_mm) || !std::isfinite(met.y_mm)) return std::nullopt;
  return met;
}

bool RigCamera::sees(const ScreenPoint& point) const noexcept {
  const auto at = project(point);
  return at && at->u_px >= 0 && at->u_px <= image_.width_px - 1 && at->v_px >= 0 && at->v_px <= image_.height_px - 1;
}

}  // namespace telehug
