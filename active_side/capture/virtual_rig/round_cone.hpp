// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "capture/virtual_rig/pinhole_camera.hpp"

namespace telehug {

// A sphere swept from `a` to `b` while its radius goes from `a_radius_mm` to `b_radius_mm`: what hands are made of
// here. The distance of a and b is greater than the difference of the radii.
struct RoundCone {
  RigPoint a;
  RigPoint b;
  double a_radius_mm = 0;
  double b_radius_mm = 0;
};

struct RayHit {
  double t = 0;     // the point is origin + t * direction
  RigPoint normal;  // of the surface, length 1
};

// Where rays from one origin first meet a round cone from outside. What depends on the cone and the origin alone is
// worked out once.
class RoundConeCaster {
 public:
  RoundConeCaster(const RoundCone& cone, const RigPoint& origin);
  [[nodiscard]] std::optional<RayHit> cast(const RigPoint& direction) const;

 private:
  RoundCone cone_;
  RigPoint origin_;
  RigPoint axis_;       // b - a
  RigPoint from_a_;     // origin - a
  RigPoint from_b_;     // origin - b
  double radius_step_;  // b_radius - a_radius
  double aa_;           // coefficient of s^2
  double s0_;           // coefficient of s, constant in t
  double c0_;           // constant term
};

}  // namespace telehug
