// SPDX-License-Identifier: Apache-2.0
#include "calibration/rig_accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "doubles/random_rig.hpp"

namespace telehug {
namespace {

struct Spread {
  double vertical = 0;  // of error / predicted error, RMS
  double horizontal = 0;
};

Spread spread(unsigned seed, std::size_t touches) {
  RandomRigs random(seed);
  constexpr double noise_px = 0.3;
  double vertical = 0, horizontal = 0;
  int count = 0;
  for (int i = 0; i < 100; ++i) {
    const KnownRig rig = random.usual_rig();
    const auto solution =
        solve_rig(random.observe(rig, touches, noise_px, noise_px), {std::nullopt, PictureOrientation{}});
    if (!solution || solution->bad_touch) continue;
    for (int p = 0; p < 20; ++p) {
      const ScreenPoint place{random.between(0.1, 0.9) * rig.screen.width_mm,
                              random.between(0.5, 1) * rig.screen.height_mm};
      if (!rig.sees_tip(place)) continue;
      ImagePoint tip = rig.tip(place);
      tip.u_px += random.normal(noise_px);
      tip.v_px += random.normal(noise_px);
      const auto found = solution->model.screen_point(tip);
      const auto predicted = predicted_error_mm(*solution, place, {noise_px, noise_px, 0});
      if (!found || !predicted) continue;
      vertical += std::pow((found->y_mm - place.y_mm) / predicted->vertical_mm, 2);
      horizontal += std::pow((found->x_mm - place.x_mm) / predicted->horizontal_mm, 2);
      ++count;
    }
  }
  EXPECT_GT(count, 800);
  return {std::sqrt(vertical / count), std::sqrt(horizontal / count)};
}

TEST(PredictedError, IsTheErrorThatRigsReallyHaveAfterNineTouches) {
  const Spread found = spread(11, 9);
  EXPECT_NEAR(found.vertical, 1, 0.2);
  EXPECT_NEAR(found.horizontal, 1, 0.2);
}

TEST(PredictedError, IsTheErrorThatRigsReallyHaveAfterFiveTouches) {
  const Spread found = spread(12, 5);
  EXPECT_NEAR(found.vertical, 1, 0.2);
  EXPECT_NEAR(found.horizontal, 1, 0.2);
}

class SolvedRig : public testing::Test {
 protected:
  RandomRigs random{13};
  KnownRig rig{{380, 300, 0, 0}, {RigCamera({950, 0.03, {195, -15, 50}, 1, -1, 2}, {1280, 720}), 12}};
  RigSolution solution = solve_rig(random.observe(rig, 9, 0.3, 0.3)).value();
};

TEST_F(SolvedRig, IsLessExactWithMoreNoise) {
  const auto usual = predicted_error_mm(solution, {190, 250}, {0.3, 0.3, 0}).value();
  const auto noisy = predicted_error_mm(solution, {190, 250}, {0.6, 0.6, 0}).value();
  const auto fingers = predicted_error_mm(solution, {190, 250}, {0.3, 0.3, 4.5}).value();
  EXPECT_GT(noisy.vertical_mm, 1.3 * usual.vertical_mm);
  EXPECT_GT(noisy.horizontal_mm, 1.3 * usual.horizontal_mm);
  EXPECT_NEAR(std::sqrt(fingers.vertical_mm * fingers.vertical_mm - usual.vertical_mm * usual.vertical_mm), 0.5, 0.2);
}

TEST_F(SolvedRig, IsMappedOverWhatItsCameraSees) {
  const auto map = error_map(solution, rig.screen, 8, 6);
  EXPECT_GT(map.size(), 15U);
  EXPECT_LT(map.size(), 48U) << "the upper corners can't be seen";
  for (const ErrorAt& place : map) {
    EXPECT_TRUE(rig.sees_tip(place.screen)) << place.screen.x_mm << " " << place.screen.y_mm;
    EXPECT_LT(place.error.vertical_mm, 3);
  }
}

TEST_F(SolvedRig, ReachesAsFarAsItsPictureDoes) {
  const Reach found = reach(rig.model, rig.screen);
  ASSERT_GE(found.outline.size(), 8U);
  // f z0 / (y - y0) = 360 px for the picture's last row, a little less with the pitch.
  EXPECT_NEAR(found.top_mm, 950 * 50 / 360.0 - 15, 20);
  EXPECT_DOUBLE_EQ(found.left_mm, 0);
  EXPECT_DOUBLE_EQ(found.right_mm, 380);
  for (const ScreenPoint& corner : found.outline) {
    EXPECT_GE(corner.x_mm, 0);
    EXPECT_LE(corner.x_mm, 380);
    EXPECT_LE(corner.y_mm, 300);
  }
  EXPECT_FALSE(rig.sees_tip({190, found.top_mm - 10}));
}

TEST(Reach, IsEmptyForACameraThatLooksAway) {
  const RigModel model{RigCamera({950, 0, {190, -15, 50}, 60}, {1280, 720}), 12};
  EXPECT_TRUE(reach(model, {380, 300, 0, 0}).outline.empty());
}

}  // namespace
}  // namespace telehug
