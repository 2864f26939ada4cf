// SPDX-License-Identifier: Apache-2.0
#include "finger/finger_colour.hpp"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgproc.hpp>

namespace telehug {
namespace {

bool accepts(const FingerColour& colour, int blue, int green, int red) {
  const std::array<std::uint8_t, 3> bgr{static_cast<std::uint8_t>(blue), static_cast<std::uint8_t>(green),
                                        static_cast<std::uint8_t>(red)};
  return colour.accepts(bgr.data());
}

TEST(Hue, IsOpenCvs) {
  for (int i = 0; i < 4096; ++i) {
    const cv::Vec3b bgr(static_cast<std::uint8_t>((i * 37) % 256), static_cast<std::uint8_t>((i * 101) % 256),
                        static_cast<std::uint8_t>((i * 7) % 256));
    cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(bgr[0], bgr[1], bgr[2]));
    cv::cvtColor(pixel, pixel, cv::COLOR_BGR2HSV);
    const float apart = std::abs(hue_180(bgr[0], bgr[1], bgr[2]) - pixel.at<cv::Vec3b>(0, 0)[0]);
    EXPECT_LE(std::min(apart, 180 - apart), 0.6F) << i;
  }
}

TEST(FingerColour, AcceptsWithinTheThesisLimits) {
  const FingerColour colour(100, 100, 100);
  EXPECT_TRUE(accepts(colour, 100, 100, 150));
  EXPECT_FALSE(accepts(colour, 100, 100, 151));
  EXPECT_FALSE(accepts(colour, 49, 49, 49));
  const FingerColour skin(110, 140, 200);
  EXPECT_TRUE(accepts(skin, 40, 70, 150));
  EXPECT_FALSE(accepts(skin, 39, 70, 150));
  EXPECT_FALSE(accepts(skin, 40, 69, 150));
}

TEST(FingerColour, ComparesHuesAroundTheCircle) {
  const FingerColour reddish(100, 90, 120);      // hue just below 180
  EXPECT_TRUE(accepts(reddish, 90, 100, 120));   // just above 0
  EXPECT_FALSE(accepts(reddish, 120, 90, 90));   // blue
  EXPECT_FALSE(accepts(reddish, 90, 120, 100));  // green
}

}  // namespace
}  // namespace telehug
