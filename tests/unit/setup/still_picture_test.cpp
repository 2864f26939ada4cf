// SPDX-License-Identifier: Apache-2.0
#include "setup/still_picture.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

class StillPictures : public testing::Test {
 protected:
  // Of a scene with noise of 3 grey levels, at 30 Hz.
  void frame(double gain = 1, int hand_at = -1) {
    cv::Mat bgr = scene * gain;
    if (hand_at >= 0) cv::rectangle(bgr, {hand_at, 0, 60, 150}, cv::Scalar(30, 45, 80), cv::FILLED);
    for (int i = 0; i < white_spots; ++i)
      cv::circle(bgr, {30 + 50 * i, 250}, 9, cv::Scalar::all(255), cv::FILLED);
    cv::Mat noise(bgr.size(), CV_16SC3);
    random.fill(noise, cv::RNG::NORMAL, 0, 3);
    cv::add(bgr, noise, bgr, cv::noArray(), CV_8UC3);
    clock.advance(33ms);
    still.look(bgr, clock.now());
  }

  // From dark to white: what is lighter than 204 is cut off when the exposure is a quarter longer.
  static cv::Mat desk() {
    cv::Mat bgr(360, 640, CV_8UC3);
    for (int u = 0; u < bgr.cols; ++u)
      bgr.col(u).setTo(cv::Scalar::all(30 + 200.0 * u / bgr.cols));
    return bgr;
  }

  FakeClock clock;
  cv::RNG random{1};
  const cv::Mat scene = desk();
  int white_spots = 0;
  StillPicture still;
};

TEST_F(StillPictures, CountHowLongNothingHasMoved) {
  for (int i = 0; i < 31; ++i)
    frame();
  EXPECT_EQ(still.still_for(), 30 * 33ms);
}

TEST_F(StillPictures, GoOnWhileTheExposureBreathes) {
  for (int i = 0; i < 31; ++i)
    frame(i % 2 == 0 ? 1.0 : 1.25);
  EXPECT_EQ(still.still_for(), 30 * 33ms);
}

// They are white in every exposure, and a field that is white in part becomes less dark than its grey would.
TEST_F(StillPictures, GoOnWhileTheExposureOfWhiteSpotsBreathes) {
  white_spots = 12;
  for (int i = 0; i < 31; ++i)
    frame(i % 2 == 0 ? 1.0 : 0.85);
  EXPECT_EQ(still.still_for(), 30 * 33ms);
}

TEST_F(StillPictures, BeginAnewWhenALampIsSwitched) {
  for (int i = 0; i < 10; ++i)
    frame(0.3);
  frame();
  EXPECT_EQ(still.still_for(), 0ms);
}

TEST_F(StillPictures, BeginAnewWhenAHandComes) {
  for (int i = 0; i < 10; ++i)
    frame();
  frame(1, 200);
  EXPECT_EQ(still.still_for(), 0ms);
}

TEST_F(StillPictures, NeverAreThoseOfAHandThatMoves) {
  for (int i = 0; i < 20; ++i) {
    frame(1, 100 + 20 * i);
    EXPECT_EQ(still.still_for(), 0ms) << i;
  }
}

TEST_F(StillPictures, GiveAPictureWithoutNoise) {
  for (int i = 0; i < 20; ++i)
    frame();
  const double deviation = cv::norm(still.picture(), scene, cv::NORM_L2) / std::sqrt(3.0 * 640 * 360);
  EXPECT_LT(deviation, 1.8);
}

TEST_F(StillPictures, GiveAPictureOfTheLastStillWhileAlone) {
  for (int i = 0; i < 20; ++i)
    frame(1, 200);
  for (int i = 0; i < 3; ++i)
    frame();
  EXPECT_LT(cv::norm(still.picture(), scene, cv::NORM_L2) / std::sqrt(3.0 * 640 * 360), 3.5);
}

TEST_F(StillPictures, BeginAnewWithPicturesOfAnotherSize) {
  for (int i = 0; i < 10; ++i)
    frame();
  cv::Mat small;
  cv::resize(scene, small, {320, 240});
  clock.advance(33ms);
  still.look(small, clock.now());
  EXPECT_EQ(still.still_for(), 0ms);
  EXPECT_EQ(still.picture().size(), small.size());
}

}  // namespace
}  // namespace telehug
