// SPDX-License-Identifier: Apache-2.0
#include "finger/thesis_detector.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "doubles/allocation_counter.hpp"
#include "doubles/drawn_finger.hpp"

namespace telehug {
namespace {

constexpr ImageSize image{1280, 720};
constexpr BorderLine level{520, 0};

TEST(ThesisDetector, FindsAFingerOfKnownWidthAndLength) {
  for (const int width : {30, 55, 90}) {
    for (const int length : {35, 60, 120}) {
      const DrawnScene scene = DrawnScene(level, image).finger(600, width, length).noise(1, 4);
      ThesisDetector detector(level, image);
      const Fingers& fingers = detector.detect(scene.picture());
      ASSERT_EQ(fingers.size(), 1U) << width << ", " << length;
      EXPECT_NEAR(fingers[0].length_px, length, 3);
      EXPECT_NEAR(fingers[0].left_px, 599.5, 1.5);
      EXPECT_NEAR(fingers[0].right_px, 599.5 + width, 1.5);
      EXPECT_NEAR(fingers[0].tip.u_px, 600 + 0.5 * (width - 1), 0.12 * width);
      EXPECT_NEAR(fingers[0].tip.v_px, 520 + length, 3);
    }
  }
}

TEST(ThesisDetector, FollowsABorderThatIsNotLevel) {
  for (const double slope : {-0.07, -0.02, 0.02, 0.07}) {
    const BorderLine border{500 - 640 * slope, slope};
    for (const int first : {40, 600, 1180}) {
      ThesisDetector detector(border, image);
      const Fingers& fingers = detector.detect(DrawnScene(border, image).finger(first, 50, 60).picture());
      ASSERT_EQ(fingers.size(), 1U) << slope << ", " << first;
      EXPECT_NEAR(fingers[0].length_px, 60, 4);
      EXPECT_NEAR(fingers[0].tip.u_px, first + 24.5, 5);
      EXPECT_NEAR(fingers[0].tip.v_px, border.v_at(fingers[0].tip.u_px) + fingers[0].length_px, 1e-9);
    }
  }
}

TEST(ThesisDetector, FindsNoFingerThatStaysAboveTheBorder) {
  ThesisDetector detector(level, image);
  EXPECT_TRUE(detector.detect(DrawnScene(level, image).noise(2, 4).picture()).empty());
  EXPECT_TRUE(detector.detect(DrawnScene(level, image).bar(600, 60, -300, -30).picture()).empty());
  EXPECT_TRUE(detector.detect(DrawnScene(level, image).bar(600, 60, -300, -5).picture()).empty());
}

TEST(ThesisDetector, FindsNoFingerThinnerThanTwentyPixels) {
  ThesisDetector detector(level, image);
  EXPECT_TRUE(detector.detect(DrawnScene(level, image).finger(600, 14, 60).picture()).empty());
  EXPECT_EQ(detector.detect(DrawnScene(level, image).finger(600, 24, 60).picture()).size(), 1U);
}

TEST(ThesisDetector, StopsWhereTheColourTearsOnlyWithContinuity) {
  // Below the tip the mirror image is torn into stripes.
  DrawnScene scene(level, image);
  scene.finger(600, 60, 50).bar(600, 60, -100, 50);
  for (int stripe = 0; stripe < 4; ++stripe)
    scene.bar(600 + 18 * stripe, 6, 50, 120);
  ThesisDetector with(level, image);
  ThesisDetector without(level, image, {.continuity = false});
  ASSERT_EQ(with.detect(scene.picture()).size(), 1U);
  ASSERT_EQ(without.detect(scene.picture()).size(), 1U);
  EXPECT_NEAR(with.detect(scene.picture())[0].length_px, 50, 4);
  EXPECT_NEAR(without.detect(scene.picture())[0].length_px, 120, 4);
}

TEST(ThesisDetector, StopsWhereTheFingerWidensOnlyWithShape) {
  const DrawnScene scene = DrawnScene(level, image).bar(600, 60, -100, 20).bar(620, 20, 20, 50).bar(600, 60, 50, 90);
  ThesisDetector with(level, image, {.continuity = false});
  ThesisDetector without(level, image, {.continuity = false, .shape = false});
  ASSERT_EQ(with.detect(scene.picture()).size(), 1U);
  ASSERT_EQ(without.detect(scene.picture()).size(), 1U);
  EXPECT_NEAR(with.detect(scene.picture())[0].length_px, 50, 4);
  EXPECT_NEAR(without.detect(scene.picture())[0].length_px, 90, 4);
}

TEST(ThesisDetector, TakesTheMiddleOfTheLastRowForTheTip) {
  // A slanting end: its last row is at the left.
  DrawnScene scene(level, image);
  scene.bar(600, 60, -100, 40);
  for (int step = 0; step < 12; ++step)
    scene.bar(600, 60 - 4 * step, 40 + 2 * step, 42 + 2 * step);
  ThesisDetector detector(level, image);
  const Fingers& fingers = detector.detect(scene.picture());
  ASSERT_EQ(fingers.size(), 1U);
  EXPECT_LT(fingers[0].tip.u_px, 614);
}

TEST(ThesisDetector, FindsNothingInBlackOrWhite) {
  ThesisDetector detector(level, image);
  for (const int grey : {0, 255})
    EXPECT_TRUE(detector.detect(cv::Mat(720, 1280, CV_8UC3, cv::Scalar::all(grey))).empty());
}

TEST(ThesisDetector, CountsPicturesOfAnotherKind) {
  ThesisDetector detector(level, image);
  EXPECT_TRUE(detector.detect(cv::Mat()).empty());
  EXPECT_TRUE(detector.detect(cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(9))).empty());
  EXPECT_TRUE(detector.detect(cv::Mat(720, 1280, CV_8UC1, cv::Scalar::all(9))).empty());
  EXPECT_EQ(detector.unfit_pictures(), 3U);
}

TEST(ThesisDetector, WorksWithABorderAtThePicturesEdge) {
  for (const double v0 : {0.0, 2.0, 12.0, 700.0, 717.0, 719.0}) {
    const BorderLine border{v0, 0};
    ThesisDetector detector(border, image);
    for (const int first : {0, 10, 600, 1220, 1240}) {
      const Fingers& fingers = detector.detect(DrawnScene(border, image).finger(first, 40, 300).picture());
      for (const Finger& finger : fingers) {
        EXPECT_LE(finger.tip.v_px, 719);
        EXPECT_LE(finger.tip.u_px, 1279);
        EXPECT_GT(finger.length_px, 0);
      }
    }
  }
}

TEST(ThesisDetector, RefusesABorderOutsideThePicture) {
  EXPECT_THROW(ThesisDetector({-1, 0}, image), std::invalid_argument);
  EXPECT_THROW(ThesisDetector({720, 0}, image), std::invalid_argument);
  EXPECT_THROW(ThesisDetector({700, 0.1}, image), std::invalid_argument);
  EXPECT_THROW(ThesisDetector({std::nan(""), 0}, image), std::invalid_argument);
}

TEST(ThesisDetector, AllocatesNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has its own heap";
  const BorderLine border{500, 0.02};
  const DrawnScene finger = DrawnScene(border, image).finger(600, 60, 150);
  const DrawnScene hand = DrawnScene(border, image).bar(100, 1000, -400, 150);
  const DrawnScene nobody(border, image);
  for (const bool continuity : {true, false}) {
    ThesisDetector detector(border, image, {.continuity = continuity});
    const auto before = allocation_count();
    for (int i = 0; i < 10; ++i) {
      detector.detect(finger.picture());
      detector.detect(hand.picture());
      detector.detect(nobody.picture());
    }
    EXPECT_EQ(allocation_count() - before, 0U);
  }
}

TEST(AllocationCounter, SeesAllocations) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has its own heap";
  const auto before = allocation_count();
  const std::vector<int> some(1000);
  EXPECT_GT(allocation_count() - before, 0U);
  EXPECT_EQ(some.size(), 1000U);
}

}  // namespace
}  // namespace telehug
