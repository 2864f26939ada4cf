// SPDX-License-Identifier: Apache-2.0
#include "body_map/screen_scale.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace telehug {
namespace {

const ScreenSize screen{.width_mm = 480, .height_mm = 300, .width_px = 1920, .height_px = 1200};

TEST(ScreenScale, TakesTheDesktopsCornersToTheScreensCorners) {
  const auto scale = make_screen_scale(screen, {.width_px = 1280, .height_px = 1024});
  ASSERT_TRUE(scale);
  EXPECT_DOUBLE_EQ(scale->to_mm(cv::Point2d(0, 0)).x_mm, 0);
  EXPECT_DOUBLE_EQ(scale->to_mm(cv::Point2d(0, 0)).y_mm, 0);
  EXPECT_DOUBLE_EQ(scale->to_mm(cv::Point2d(1280, 1024)).x_mm, 480);
  EXPECT_DOUBLE_EQ(scale->to_mm(cv::Point2d(1280, 1024)).y_mm, 300);
}

TEST(ScreenScale, ScalesEachAxisByItself) {
  const auto scale = make_screen_scale(screen, {.width_px = 480, .height_px = 600});
  ASSERT_TRUE(scale);
  const ScreenRect rect = scale->to_mm(cv::Rect2d(10, 20, 30, 40));
  EXPECT_DOUBLE_EQ(rect.x_mm, 10);
  EXPECT_DOUBLE_EQ(rect.y_mm, 10);
  EXPECT_DOUBLE_EQ(rect.width_mm, 30);
  EXPECT_DOUBLE_EQ(rect.height_mm, 20);
}

TEST(ScreenScale, TakesTheScreensOwnPixelsWhereNoDesktopIsGiven) {
  const auto scale = make_screen_scale(screen, {});
  ASSERT_TRUE(scale);
  EXPECT_DOUBLE_EQ(scale->mm_per_px_x, 0.25);
  EXPECT_DOUBLE_EQ(scale->mm_per_px_y, 0.25);
}

TEST(ScreenScale, ComesBackToTheSamePixels) {
  const auto scale = make_screen_scale(screen, {.width_px = 1366, .height_px = 768});
  ASSERT_TRUE(scale);
  const cv::Rect2d back = scale->to_px(scale->to_mm(cv::Rect2d(-12.5, 700, 301, 99)));
  EXPECT_NEAR(back.x, -12.5, 1e-9);
  EXPECT_NEAR(back.y, 700, 1e-9);
  EXPECT_NEAR(back.width, 301, 1e-9);
  EXPECT_NEAR(back.height, 99, 1e-9);
}

TEST(ScreenScale, RefusesSizesThatAreNotAboveZero) {
  EXPECT_FALSE(make_screen_scale({}, {}));
  EXPECT_FALSE(make_screen_scale(screen, {.width_px = -1, .height_px = 100}));
  EXPECT_FALSE(make_screen_scale(screen, {.width_px = 100, .height_px = 0}));
  for (const double bad_mm : {0.0, -300.0, std::numeric_limits<double>::quiet_NaN()}) {
    const auto scale = make_screen_scale({.width_mm = 480, .height_mm = bad_mm}, {.width_px = 10, .height_px = 10});
    ASSERT_FALSE(scale);
    EXPECT_THAT(scale.error().message, testing::HasSubstr("width and height in mm"));
  }
}

}  // namespace
}  // namespace telehug
