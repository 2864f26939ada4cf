// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/left_out_areas.hpp"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/core.hpp>
#include <random>

namespace telehug {
namespace {

TEST(LeftOutAreas, CoverWhatLiesWithinThemTogether) {
  const std::array areas{cv::Rect(0, 0, 10, 5), cv::Rect(10, 0, 10, 10), cv::Rect(0, 5, 10, 5)};
  EXPECT_TRUE(is_covered({0, 0, 20, 10}, areas));
  EXPECT_TRUE(is_covered({5, 2, 10, 6}, areas));
  EXPECT_FALSE(is_covered({5, 2, 10, 9}, areas));
  EXPECT_FALSE(is_covered({-1, 0, 2, 2}, areas));
  EXPECT_FALSE(is_covered({30, 30, 1, 1}, areas));
  EXPECT_FALSE(is_covered({0, 0, 1, 1}, {}));
  EXPECT_TRUE(is_covered({}, {}));
}

TEST(LeftOutAreas, CoverAsPaintWould) {
  std::mt19937 random(7);
  const auto any_rect = [&random](int longest) {
    std::uniform_int_distribution<int> place(0, 11);
    std::uniform_int_distribution<int> length(1, longest);
    return cv::Rect(place(random), place(random), length(random), length(random));
  };
  int covered = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::array areas{any_rect(12), any_rect(12), any_rect(12), any_rect(12)};
    const cv::Rect rect = any_rect(6);
    cv::Mat1b paint(24, 24, std::uint8_t{0});
    for (const cv::Rect& area : areas)
      paint(area) = 1;
    const bool painted = cv::countNonZero(paint(rect)) == rect.area();
    covered += painted ? 1 : 0;
    ASSERT_EQ(is_covered(rect, areas), painted) << i;
  }
  EXPECT_GT(covered, 500);
}

TEST(LeftOutAreas, ArePutBackIntoAPictureThatWasFilledAnew) {
  cv::Mat picture(10, 10, CV_8UC4, cv::Scalar(1, 2, 3, 4));
  const std::array areas{cv::Rect(-5, -5, 7, 7), cv::Rect(8, 3, 100, 1), cv::Rect(20, 20, 5, 5)};
  KeptAreas kept;
  kept.keep(picture, areas);
  picture.setTo(cv::Scalar(9, 9, 9, 9));
  kept.put_back(picture);
  EXPECT_EQ(picture.at<cv::Vec4b>(1, 1), cv::Vec4b(1, 2, 3, 4));
  EXPECT_EQ(picture.at<cv::Vec4b>(2, 1), cv::Vec4b(9, 9, 9, 9));
  EXPECT_EQ(picture.at<cv::Vec4b>(3, 9), cv::Vec4b(1, 2, 3, 4));
  EXPECT_EQ(picture.at<cv::Vec4b>(3, 7), cv::Vec4b(9, 9, 9, 9));
}

}  // namespace
}  // namespace telehug
