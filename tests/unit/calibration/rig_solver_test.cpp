// SPDX-License-Identifier: Apache-2.0
#include "calibration/rig_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "doubles/random_rig.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

constexpr double exact_px = 1e-4;  // noise of exact projections: far less than what 0.01 mm on the screen is

// The largest distance between touches and where the solved model places them, over what the camera sees.
double largest_error_mm(const KnownRig& rig, const RigModel& solved, RandomRigs& random) {
  double largest = 0;
  for (int i = 0; i < 50; ++i) {
    const ScreenPoint place{random.between(0, rig.screen.width_mm), random.between(0.3, 1) * rig.screen.height_mm};
    if (!rig.sees_tip(place)) continue;
    const auto found = solved.screen_point(rig.tip(place));
    if (!found) return INFINITY;
    largest = std::max(largest, std::hypot(found->x_mm - place.x_mm, found->y_mm - place.y_mm));
  }
  return largest;
}

TEST(RigSolver, GivesBackEveryRigFromExactProjections) {
  RandomRigs random(3);
  for (int i = 0; i < 50; ++i) {
    const KnownRig rig = random.rig();
    const auto solution = solve_rig(random.observe(rig, 9, 0, exact_px));
    ASSERT_TRUE(solution.ok()) << solution.error().message;
    ASSERT_LT(largest_error_mm(rig, solution->model, random), 0.01) << "rig " << i;
    ASSERT_FALSE(solution->bad_touch.has_value());
    ASSERT_LT(solution->border_rms_px, 0.001);
  }
}

TEST(RigSolver, GivesBackEveryRigFromFiveTouchesAndTheBorder) {
  RandomRigs random(4);
  for (int i = 0; i < 40; ++i) {
    const KnownRig rig = random.rig();
    const auto solution = solve_rig(random.observe(rig, 5, 0, exact_px));
    ASSERT_TRUE(solution.ok()) << solution.error().message;
    ASSERT_LT(largest_error_mm(rig, solution->model, random), 0.01) << "rig " << i;
  }
}

TEST(RigSolver, TellsHowThePictureIsTurned) {
  RandomRigs random(5);
  for (int i = 0; i < 32; ++i) {
    const PictureOrientation orientation{i % 2 == 1, i % 4 >= 2};
    const KnownRig rig = random.rig(orientation);
    const auto solution = solve_rig(random.observe(rig, i % 3 == 0 ? 2 : 5, 0.3, 0.3));
    ASSERT_TRUE(solution.ok()) << solution.error().message;
    ASSERT_EQ(solution->model.camera.orientation(), orientation)
        << solution->model.camera.orientation().name() << " instead of " << orientation.name() << ", rig " << i;
  }
}

TEST(RigSolver, FindsTheOneBadTouch) {
  RandomRigs random(6);
  for (int i = 0; i < 24; ++i) {
    const KnownRig rig = random.rig();
    RigObservations seen = random.observe(rig, i % 2 == 0 ? 9 : 5, 0.3, 0.3);
    const auto bad = static_cast<std::size_t>(i) % seen.touches.size();
    const double turn = random.between(0, 6.28);
    seen.touches[bad].image.u_px += 40 * std::cos(turn);
    seen.touches[bad].image.v_px += 40 * std::sin(turn);
    const auto solution = solve_rig(seen);
    ASSERT_TRUE(solution.ok()) << solution.error().message;
    ASSERT_TRUE(solution->bad_touch.has_value()) << "rig " << i;
    ASSERT_EQ(*solution->bad_touch, bad) << "rig " << i;
    ASSERT_EQ(solution->touches.size(), seen.touches.size());
    ASSERT_GT(solution->touches[bad].standardised, 10);
  }
}

TEST(RigSolver, IsNotBentByBorderPointsOfAnotherEdge) {
  RandomRigs random(14);
  for (int i = 0; i < 20; ++i) {
    const KnownRig rig = random.rig();
    RigObservations seen = random.observe(rig, 9, 0, 0.3);
    for (const std::size_t point : {3U, 4U, 11U})
      seen.border[point].image.v_px += 15;
    const auto solution = solve_rig(seen, {std::nullopt, PictureOrientation{}});
    ASSERT_TRUE(solution.ok()) << solution.error().message;
    ASSERT_LT(largest_error_mm(rig, solution->model, random), 1.5) << "rig " << i;
  }
}

TEST(RigSolver, FindsNoBadTouchAmongGoodOnes) {
  RandomRigs random(7);
  int found = 0;
  for (int i = 0; i < 40; ++i) {
    const auto solution = solve_rig(random.observe(random.rig(), 9, 0.3, 0.3));
    ASSERT_TRUE(solution.ok()) << solution.error().message;
    found += solution->bad_touch ? 1 : 0;
  }
  EXPECT_LE(found, 1);
}

TEST(RigSolver, TellsByChiSquaredWhetherTheNoiseIsWhatItWasSaidToBe) {
  RandomRigs random(8);
  double said = 0, larger = 0;
  constexpr int rigs = 25;
  for (int i = 0; i < rigs; ++i) {
    const KnownRig rig = random.usual_rig();
    said += solve_rig(random.observe(rig, 9, 0.3, 0.3)).value().reduced_chi2 / rigs;
    larger += solve_rig(random.observe(rig, 9, 0.6, 0.3)).value().reduced_chi2 / rigs;
  }
  EXPECT_NEAR(said, 1, 0.2);
  EXPECT_GT(larger, 2.5);
}

TEST(RigSolver, UsesMarksThatLieFlatOnTheScreen) {
  RandomRigs random(9);
  const KnownRig rig = random.rig();
  RigObservations seen = random.observe(rig, 9, 0, exact_px, false);
  seen.marks = seen.touches;
  seen.touches.clear();
  for (PointObservation& mark : seen.marks)
    mark.image = rig.model.camera.project(mark.screen).value();
  const auto solution = solve_rig(seen);
  ASSERT_TRUE(solution.ok()) << solution.error().message;
  EXPECT_LT(largest_error_mm(rig, {solution->model.camera, rig.model.contact_radius_mm}, random), 0.01);
}

TEST(RigSolver, SaysWhatIsMissing) {
  RandomRigs random(10);
  const RigObservations good = random.observe(random.rig(), 5, 0, 0.3);
  RigObservations seen = good;
  seen.touches.resize(1);
  EXPECT_THAT(solve_rig(seen).error().message, HasSubstr("too few"));
  seen = good;
  seen.touches[2].image.u_px = NAN;
  EXPECT_THAT(solve_rig(seen).error().message, HasSubstr("calibration touch 3"));
  seen = good;
  seen.screen.height_mm = 0;
  EXPECT_THAT(solve_rig(seen).error().message, HasSubstr("screen's size"));
}

}  // namespace
}  // namespace telehug
