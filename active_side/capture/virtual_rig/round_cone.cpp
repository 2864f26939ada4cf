// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/round_cone.hpp"

#include <cmath>

namespace telehug {
namespace {

// Smaller root of p t^2 + 2 q t + r = 0.
std::optional<double> first_root(double p, double q, double r) {
  const double discriminant = q * q - p * r;
  if (discriminant < 0) return std::nullopt;
  return (-q - std::sqrt(discriminant)) / p;
}

}  // namespace

// A point x lies inside the sweep where, for some s in [0, 1],
//   F(s) = |x - a - s axis|^2 - (ra + s dr)^2 = A s^2 + 2 B s + C <= 0,
//   A = |axis|^2 - dr^2,   B = -((x - a) . axis + ra dr),   C = |x - a|^2 - ra^2.
// For the endless sweep the least F is C - B^2 / A at s = -B / A, so its surface is A C - B^2 = 0: with
// x = origin + t direction a quadratic in t. Where s falls outside [0, 1], the sphere at that end is the surface.
RoundConeCaster::RoundConeCaster(const RoundCone& cone, const RigPoint& origin)
    : cone_(cone),
      origin_(origin),
      axis_(cone.b - cone.a),
      from_a_(origin - cone.a),
      from_b_(origin - cone.b),
      radius_step_(cone.b_radius_mm - cone.a_radius_mm),
      aa_(axis_.dot(axis_) - radius_step_ * radius_step_),
      s0_(-(from_a_.dot(axis_) + cone.a_radius_mm * radius_step_)),
      c0_(from_a_.dot(from_a_) - cone.a_radius_mm * cone.a_radius_mm) {}

std::optional<RayHit> RoundConeCaster::cast(const RigPoint& direction) const {
  const double dd = direction.dot(direction);
  const double da = direction.dot(from_a_);
  const double s1 = -direction.dot(axis_);
  const auto t = first_root(aa_ * dd - s1 * s1, aa_ * da - s0_ * s1, aa_ * c0_ - s0_ * s0_);
  if (!t) return std::nullopt;  // the ends lie within the endless sweep
  double s = -(s0_ + s1 * *t) / aa_;
  double hit_t = *t;
  if (s < 0) {
    const auto end = first_root(dd, da, c0_);
    if (!end) return std::nullopt;
    hit_t = *end;
    s = 0;
  } else if (s > 1) {
    const double cb = from_b_.dot(from_b_) - cone_.b_radius_mm * cone_.b_radius_mm;
    const auto end = first_root(dd, direction.dot(from_b_), cb);
    if (!end) return std::nullopt;
    hit_t = *end;
    s = 1;
  }
  if (hit_t <= 0) return std::nullopt;
  const RigPoint centre = cone_.a + s * axis_;
  return RayHit{hit_t, (origin_ + hit_t * direction - centre) * (1 / (cone_.a_radius_mm + s * radius_step_))};
}

}  // namespace telehug
