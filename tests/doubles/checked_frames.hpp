// SPDX-License-Identifier: Apache-2.0
//
// Frames of a camera for the tests of the frame check.
#pragma once

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "capture/frame_check.hpp"

namespace telehug {

inline constexpr ImageSize size{1280, 720};
inline constexpr BorderPlace border{520, 0.01};

class AFrame : public testing::Test {
 protected:
  // A desk with things on it above a screen, and the sensor's noise, which never repeats.
  cv::Mat scene(double light = 1) {
    cv::Mat picture(size.height_px, size.width_px, CV_8UC3, cv::Scalar(90, 110, 130));
    for (int column = 0; column < size.width_px; column += 160)
      cv::rectangle(picture, {column, 0, 80, 200 + column / 8}, cv::Scalar(40, 60 + column / 12, 70), cv::FILLED);
    picture.rowRange(520, 720).setTo(cv::Scalar(180, 170, 160));
    picture(cv::Rect(900, 540, 300, 180)).setTo(cv::Scalar(60, 30, 30));
    picture.convertTo(picture, CV_8UC3, light);
    return noisy(picture);
  }
  cv::Mat noisy(const cv::Mat& picture) {
    cv::Mat noise(picture.size(), CV_16SC3);
    random_.fill(noise, cv::RNG::NORMAL, 0, 3);
    cv::Mat result;
    cv::add(picture, noise, result, cv::noArray(), CV_8UC3);
    return result;
  }
  FrameVerdict verdict(const cv::Mat& picture) { return check_.check(picture).verdict; }
  // Good ones, until everything is known that is learnt from them.
  void watch(int frames = 40) {
    for (int i = 0; i < frames; ++i)
      ASSERT_EQ(verdict(scene()), FrameVerdict::good);
  }
  void expect_recovery() { EXPECT_EQ(verdict(scene()), FrameVerdict::good); }

  FrameCheck check_{size, border};
  cv::RNG random_{3};
};

}  // namespace telehug
