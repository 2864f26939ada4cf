// SPDX-License-Identifier: Apache-2.0
#include "calibration/thesis_touch_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "doubles/aligned_rig.hpp"
#include "unit/calibration/mirrored_equations.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

constexpr int random_rigs = 10'000;
constexpr double exact_mm = 1e-5;  // what rounding leaves in the worst of the rigs

class RandomRigs : public testing::Test {
 protected:
  double between(double least, double most) { return std::uniform_real_distribution(least, most)(random_); }

  AlignedRig rig() {
    AlignedRig rig;
    rig.screen = {between(300, 700), between(180, 420), 1920, 1080};
    rig.camera_x_mm = between(-0.2, 1.2) * rig.screen.width_mm;  // off-centre
    rig.camera_below_top_mm = between(-150, 40);                 // above and below the edge
    rig.vertical_scale = between(500, 1500) * between(15, 80);
    rig.horizontal_scale_px = between(500, 1500) * (between(0, 1) < 0.5 ? -1 : 1);  // mirrored or not
    return rig;
  }

  // A point that the camera sees.
  ScreenPoint point(const AlignedRig& rig) {
    return {between(0, rig.screen.width_mm),
            between(std::max(60.0, rig.camera_below_top_mm + 20), rig.screen.height_mm - 5)};
  }

  // Two points that can be told apart.
  std::pair<MeasuredTouch, MeasuredTouch> touches(const AlignedRig& rig) {
    while (true) {
      const ScreenPoint a = point(rig);
      const ScreenPoint b = point(rig);
      if (std::abs(a.x_mm - b.x_mm) > 15 && std::abs(a.y_mm - b.y_mm) > 15) return {rig.project(a), rig.project(b)};
    }
  }

  std::mt19937 random_{20260101};
};

TEST_F(RandomRigs, GiveBackEveryPointFromItsExactProjection) {
  int above = 0;
  for (int i = 0; i < random_rigs; ++i) {
    const AlignedRig rig = this->rig();
    const auto [first, second] = touches(rig);
    const auto model = ThesisTouchModel::solve(rig.screen, first, second);
    ASSERT_TRUE(model.ok()) << model.error().message;
    ASSERT_NEAR(model->camera_below_top_mm(), rig.camera_below_top_mm, exact_mm);
    ASSERT_NEAR(model->horizontal_scale_px(), rig.horizontal_scale_px, 1e-3);
    above += rig.camera_below_top_mm < 0 ? 1 : 0;
    for (int p = 0; p < 3; ++p) {
      const MeasuredTouch seen = rig.project(point(rig));
      const auto found = model->screen_point(seen.length_px, seen.column_px);
      ASSERT_TRUE(found.has_value());
      ASSERT_NEAR(found->x_mm, seen.screen.x_mm, exact_mm) << "rig " << i;
      ASSERT_NEAR(found->y_mm, seen.screen.y_mm, exact_mm) << "rig " << i;
    }
  }
  EXPECT_GT(above, random_rigs / 4);
  EXPECT_LT(above, random_rigs - 1000);
}

TEST_F(RandomRigs, AgreeWithTheEquationsForACameraAboveTheScreen) {
  for (int i = 0; i < random_rigs; ++i) {
    const AlignedRig rig = this->rig();
    const auto [first, second] = touches(rig);
    const auto model = ThesisTouchModel::solve(rig.screen, first, second);
    ASSERT_TRUE(model.ok()) << model.error().message;
    const MirroredEquations mirrored{rig.screen.height_mm, first, second};
    EXPECT_NEAR(mirrored.camera_above_top_mm(), -model->camera_below_top_mm(), exact_mm);
    // Also where the finger is not exactly where a point would be.
    const MeasuredTouch seen = rig.project(point(rig));
    const double length_px = seen.length_px * between(0.7, 1.3);
    const double column_px = seen.column_px + between(-50, 50);
    const auto found = model->screen_point(length_px, column_px);
    ASSERT_TRUE(found.has_value());
    const ScreenPoint expected = mirrored.screen_point(length_px, column_px);
    ASSERT_NEAR(found->x_mm, expected.x_mm, exact_mm);
    ASSERT_NEAR(found->y_mm, expected.y_mm, exact_mm);
  }
}

class ThesisModel : public testing::Test {
 protected:
  [[nodiscard]] std::string reason(const MeasuredTouch& a, const MeasuredTouch& b) const {
    const auto model = ThesisTouchModel::solve(rig_.screen, a, b);
    return model.ok() ? "it was solved" : model.error().message;
  }

  // The thesis' own rig: a screen 300 mm high, touched in the middle and 30 mm to the right of it.
  AlignedRig rig_{{380, 300, 1280, 1024}, 187, 12, 950.0 * 40, -950};
  MeasuredTouch first_ = rig_.project({190, 100});
  MeasuredTouch second_ = rig_.project({220, 220});
};

TEST_F(ThesisModel, SolvesTheTouchesOfTheThesisInEitherOrder) {
  const auto model = ThesisTouchModel::solve(rig_.screen, first_, second_);
  const auto swapped = ThesisTouchModel::solve(rig_.screen, second_, first_);
  ASSERT_TRUE(model.ok() && swapped.ok());
  EXPECT_NEAR(model->camera_below_top_mm(), 12, 1e-9);
  EXPECT_NEAR(swapped->camera_below_top_mm(), 12, 1e-9);
}

TEST_F(ThesisModel, IsCalibratedWithThePointsOfTheThesis) {
  const auto points = default_calibration_points(rig_.screen);
  EXPECT_DOUBLE_EQ(points[0].x_mm, 190);
  EXPECT_DOUBLE_EQ(points[0].y_mm, 100);
  EXPECT_DOUBLE_EQ(points[1].x_mm, 220);
  EXPECT_DOUBLE_EQ(points[1].y_mm, 220);
  for (const ScreenSize& screen : {ScreenSize{408, 255, 1440, 900}, ScreenSize{700, 390, 3840, 2160}}) {
    const AlignedRig rig{screen, 150, -12, 950.0 * 40, -950};
    const auto [first, second] = default_calibration_points(screen);
    EXPECT_TRUE(ThesisTouchModel::solve(screen, rig.project(first), rig.project(second)).ok());
  }
}

TEST_F(ThesisModel, PlacesAFingerOfNoLengthOnTheBottomEdge) {
  const auto model = ThesisTouchModel::solve(rig_.screen, first_, second_);
  ASSERT_TRUE(model.ok());
  const auto point = model->screen_point(0, 0);
  ASSERT_TRUE(point.has_value());
  EXPECT_NEAR(point->y_mm, 300, 1e-9);
  EXPECT_NEAR(point->x_mm, 187, 1e-9);
}

TEST_F(ThesisModel, PlacesNothingWhereNoPointLooksLikeThat) {
  const auto model = ThesisTouchModel::solve(rig_.screen, first_, second_);
  ASSERT_TRUE(model.ok());
  EXPECT_FALSE(model->screen_point(-1e5, 0).has_value());
  EXPECT_FALSE(model->screen_point(std::numeric_limits<double>::quiet_NaN(), 0).has_value());
  EXPECT_FALSE(model->screen_point(50, std::numeric_limits<double>::infinity()).has_value());
}

TEST_F(ThesisModel, SaysThatEqualLengthsAreImpossible) {
  second_.length_px = first_.length_px;
  EXPECT_THAT(reason(first_, second_), HasSubstr("calibration touch 1 at (190.0, 100.0) mm has a finger of"));
  // In the other order it is the second one that is too short.
  EXPECT_THAT(reason(second_, first_), HasSubstr("calibration touch 2 at (190.0, 100.0) mm has a finger of"));
}

TEST_F(ThesisModel, SaysThatAFingerInProportionToItsHeightNeedsACameraInfinitelyFarAway) {
  first_.length_px = second_.length_px * (300 - 100) / (300 - 220);
  EXPECT_THAT(reason(first_, second_), HasSubstr("must be longer than"));
  first_.length_px += 0.01;
  EXPECT_EQ(reason(first_, second_), "it was solved");
}

TEST_F(ThesisModel, SaysWhichTouchHasNoLength) {
  second_.length_px = 0;
  EXPECT_THAT(reason(first_, second_), HasSubstr("calibration touch 2 at (220.0, 220.0) mm has a finger of 0 px"));
  second_.length_px = -4;
  EXPECT_THAT(reason(first_, second_), HasSubstr("calibration touch 2"));
  first_.length_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(reason(first_, second_), HasSubstr("calibration touch 1"));
}

TEST_F(ThesisModel, SaysWhichTouchIsNoPointOfTheScreen) {
  MeasuredTouch touch = first_;
  touch.screen.y_mm = 300;
  EXPECT_THAT(reason(touch, second_), HasSubstr("calibration touch 1 at (190.0, 300.0) mm is not on the screen"));
  touch.screen.y_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(reason(first_, touch), HasSubstr("calibration touch 2"));
  touch = second_;
  touch.column_px = std::numeric_limits<double>::infinity();
  EXPECT_THAT(reason(first_, touch), HasSubstr("no image column"));
}

TEST_F(ThesisModel, NeedsTwoHeightsAndTwoSides) {
  EXPECT_THAT(reason(first_, rig_.project({230, 100.2})), HasSubstr("as high as the first"));
  EXPECT_THAT(reason(first_, rig_.project({190.2, 220})), HasSubstr("straight below or above the first"));
}

TEST_F(ThesisModel, SaysThatTouchesInOneLineOfSightAreImpossible) {
  second_.column_px = first_.column_px * (100.0 - 12) / (220 - 12);
  EXPECT_THAT(reason(first_, second_), HasSubstr("straight in line with the first"));
}

TEST_F(ThesisModel, RefusesAScreenWithoutASize) {
  rig_.screen.height_mm = 0;
  EXPECT_THAT(reason(first_, second_), HasSubstr("the screen's size"));
}

}  // namespace
}  // namespace telehug
