// SPDX-License-Identifier: Apache-2.0
#include "capture/light_meter.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

cv::Mat grey(int value) {
  return {120, 160, CV_8UC3, cv::Scalar::all(value)};
}

// Of pictures of these greys, 50 ms apart.
Light light_of(const std::vector<int>& greys) {
  LightMeter meter;
  Timestamp time = from_ns(1'000'000'000);
  for (const int value : greys) {
    meter.add(grey(value), time);
    time += std::chrono::milliseconds(50);
  }
  return meter.light();
}

TEST(LightMeter, WithoutPicturesTellsNothing) {
  EXPECT_EQ(LightMeter().light().pictures, 0);
  EXPECT_EQ(light_of({100}).rate_hz, 0);
}

TEST(LightMeter, TellsBrightnessAndRate) {
  const Light light = light_of({51, 51, 51});
  EXPECT_NEAR(light.mean, 0.2, 1e-6);
  EXPECT_NEAR(light.rate_hz, 20, 1e-6);
  EXPECT_EQ(light.flicker, 0);
}

TEST(LightMeter, TellsWhichPartIsBlownOutAndWhichIsBlack) {
  cv::Mat picture = grey(100);
  picture.colRange(0, 40).setTo(cv::Scalar::all(255));
  picture.colRange(40, 60).setTo(cv::Scalar::all(3));
  LightMeter meter;
  meter.add(picture, from_ns(0));
  EXPECT_NEAR(meter.light().blown_share, 0.25, 1e-9);
  EXPECT_NEAR(meter.light().dark_share, 0.125, 1e-9);
}

TEST(LightMeter, TellsALampThatFlickersFromAHandThatMoves) {
  EXPECT_NEAR(light_of({90, 110, 90, 110, 90}).flicker, 20.0 / 98, 1e-6);
  EXPECT_NEAR(light_of({90, 95, 100, 105, 110}).flicker, 0, 1e-9);
}

}  // namespace
}  // namespace telehug
