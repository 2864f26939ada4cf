// SPDX-License-Identifier: Apache-2.0
#include "setup/dot_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace telehug {
namespace {

constexpr ScreenSize screen{380, 300, 1280, 1024};

RigCamera camera(double pitch_deg = 0, double yaw_deg = 0) {
  return {{1000, -0.03, {190, -15, 50}, pitch_deg, yaw_deg, 0}, {1280, 720}};
}

void expect_all_seen_and_apart(const RigCamera& seen_by, const std::vector<ScreenPoint>& dots) {
  for (std::size_t i = 0; i < dots.size(); ++i) {
    EXPECT_TRUE(sees_dot(seen_by, dots[i], 12)) << i;
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GE(std::hypot(dots[i].x_mm - dots[k].x_mm, dots[i].y_mm - dots[k].y_mm), least_between_dots_mm);
  }
}

TEST(DotPlans, HaveNineDotsOfWhichNoneIsOutsideTheCamerasReach) {
  const auto dots = plan_dots(camera(), screen, full_calibration_dots, 12);
  EXPECT_EQ(dots.size(), 9U);
  expect_all_seen_and_apart(camera(), dots);
}

TEST(DotPlans, MoveDotsThatACameraDoesNotSee) {
  for (const RigCamera& askew : {camera(4), camera(-4), camera(0, 4), camera(3, -4)}) {
    const auto dots = plan_dots(askew, screen, full_calibration_dots, 12);
    EXPECT_GE(dots.size(), 7U);
    expect_all_seen_and_apart(askew, dots);
  }
}

TEST(DotPlans, OfTwoDotsLieFarToTheLeftAndRight) {
  const auto dots = plan_dots(camera(), screen, quick_calibration_dots, 12);
  ASSERT_EQ(dots.size(), 2U);
  EXPECT_LT(dots[0].x_mm, 120);
  EXPECT_GT(dots[1].x_mm, 260);
}

TEST(DotPlans, AreEmptyForACameraThatSeesNothingOfTheScreen) {
  EXPECT_TRUE(plan_dots(camera(60), screen, full_calibration_dots, 12).empty());
}

TEST(DotPlans, DoNotTakeADotForSeenOfWhichAPartIsOutside) {
  const RigCamera seen_by = camera();
  double y = 60;
  while (!seen_by.sees({190, y}))
    y += 0.5;
  EXPECT_TRUE(seen_by.sees({190, y}));
  EXPECT_FALSE(sees_dot(seen_by, {190, y}, 0)) << "its upper half is outside";
}

}  // namespace
}  // namespace telehug
