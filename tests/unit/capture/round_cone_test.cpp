// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/round_cone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace telehug {
namespace {

// Distance of a point from the surface, by trying many balls of the sweep.
double depth_inside_mm(const RoundCone& cone, const RigPoint& point) {
  double deepest = -1e9;
  for (int i = 0; i <= 400; ++i) {
    const double s = i / 400.0;
    const RigPoint centre = cone.a + s * (cone.b - cone.a);
    const double radius = cone.a_radius_mm + s * (cone.b_radius_mm - cone.a_radius_mm);
    deepest = std::max(deepest, radius - cv::norm(point - centre));
  }
  return deepest;
}

TEST(RoundCone, IsHitOnItsSurfaceAndNowhereBefore) {
  const RoundCone cone{{10, 200, 5}, {18, 230, 40}, 5, 9};
  const RigPoint origin{0, 0, 50};
  const RoundConeCaster caster(cone, origin);
  std::mt19937 generator(1);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto up_to = [&](unsigned long end) { return static_cast<double>(generator() % end); };
    const RigPoint aim{up_to(60) - 20, up_to(70) + 180, up_to(70) - 10};
    const RigPoint ray = aim - origin;
    const auto hit = caster.cast(ray);
    if (hit) {
      ++hits;
      EXPECT_NEAR(depth_inside_mm(cone, origin + hit->t * ray), 0, 5e-3);
      EXPECT_NEAR(cv::norm(hit->normal), 1, 1e-9);
      EXPECT_LT(hit->normal.dot(ray), 1e-9);
    }
    const double reach = hit ? hit->t - 1e-6 : 1.6;
    for (double t = 0.5; t < reach; t += 0.01)
      EXPECT_LT(depth_inside_mm(cone, origin + t * ray), 1e-6);
  }
  EXPECT_GT(hits, 100);
}

TEST(RoundCone, BehindTheOriginIsNotHit) {
  const RoundConeCaster caster({{0, -50, 0}, {0, -80, 0}, 5, 5}, {0, 0, 0});
  EXPECT_FALSE(caster.cast({0.01, 1, 0}).has_value());
}

}  // namespace
}  // namespace telehug
