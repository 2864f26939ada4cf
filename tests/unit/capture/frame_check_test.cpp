// SPDX-License-Identifier: Apache-2.0
#include "capture/frame_check.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "doubles/allocation_counter.hpp"
#include "doubles/checked_frames.hpp"

namespace telehug {
namespace {

TEST_F(AFrame, IsGoodAsACameraTakesIt) {
  for (int i = 0; i < 100; ++i) {
    cv::Mat picture = scene();
    cv::rectangle(picture, {300 + 4 * i, 300, 60, 300}, cv::Scalar(90, 120, 180), cv::FILLED);  // a finger that moves
    const FrameFindings findings = check_.check(picture);
    ASSERT_EQ(findings.verdict, FrameVerdict::good);
    ASSERT_FALSE(findings.duplicate);
    ASSERT_LT(findings.desk_change, 0.05);
    ASSERT_FALSE(findings.settling);
  }
}

TEST_F(AFrame, OfAnotherSizeOrKindIsRefused) {
  watch();
  EXPECT_EQ(verdict(cv::Mat()), FrameVerdict::other_size);
  EXPECT_EQ(verdict(cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(9))), FrameVerdict::other_size);
  EXPECT_EQ(verdict(cv::Mat(1280, 720, CV_8UC3, cv::Scalar::all(9))), FrameVerdict::other_size)
      << "turned by 90 degrees";
  EXPECT_EQ(verdict(cv::Mat(720, 1280, CV_8UC1, cv::Scalar(9))), FrameVerdict::other_size);
  expect_recovery();
}

TEST_F(AFrame, IsBlankWhenItIsBlackWhiteOrOfOneColour) {
  watch();
  const auto plain = [](double level) { return cv::Mat(720, 1280, CV_8UC3, cv::Scalar::all(level)); };
  EXPECT_EQ(verdict(plain(0)), FrameVerdict::blank);
  EXPECT_EQ(verdict(noisy(plain(3))), FrameVerdict::blank);
  EXPECT_EQ(verdict(plain(255)), FrameVerdict::blank);
  EXPECT_EQ(verdict(plain(128)), FrameVerdict::blank);
  EXPECT_EQ(verdict(cv::Mat(720, 1280, CV_8UC3, cv::Scalar(0, 135, 0))), FrameVerdict::blank)
      << "a driver's empty buffer";
  expect_recovery();
}

TEST_F(AFrame, IsTornWhenItsLowerPartWasNeverFilled) {
  watch();
  for (const int first_row : {100, 400, 620}) {
    cv::Mat picture = scene();
    picture.rowRange(first_row, 720).setTo(cv::Scalar(128, 128, 128));
    EXPECT_EQ(verdict(picture), FrameVerdict::torn) << first_row;
    expect_recovery();
  }
}

TEST_F(AFrame, IsTornWhenAPartStillShowsThePictureBefore) {
  watch();
  cv::Mat before = scene();
  ASSERT_EQ(verdict(before), FrameVerdict::good);
  for (const int first_row : {90, 360, 600}) {
    cv::Mat picture = scene();
    before.rowRange(first_row, 720).copyTo(picture.rowRange(first_row, 720));
    EXPECT_EQ(verdict(picture), FrameVerdict::torn) << first_row;
    before = scene();
    EXPECT_EQ(verdict(before), FrameVerdict::good);
  }
  cv::Mat picture = scene();
  before.rowRange(0, 300).copyTo(picture.rowRange(0, 300));
  EXPECT_EQ(verdict(picture), FrameVerdict::torn);
}

TEST_F(AFrame, IsNotTornBecauseADarkOrStillPartStandsStill) {
  cv::Mat still = scene();
  still.rowRange(400, 720).setTo(cv::Scalar::all(0));
  for (int i = 0; i < 60; ++i) {
    cv::Mat picture = scene();
    still.rowRange(300, 720).copyTo(picture.rowRange(300, 720));
    ASSERT_EQ(verdict(picture), FrameVerdict::good) << i;
  }
}

TEST_F(AFrame, MayComeTwiceButNotForHalfASecond) {
  watch();
  const cv::Mat picture = scene();
  ASSERT_EQ(verdict(picture), FrameVerdict::good);
  for (int i = 1; i < 15; ++i) {
    const FrameFindings findings = check_.check(picture);
    ASSERT_EQ(findings.verdict, FrameVerdict::good) << i;
    ASSERT_TRUE(findings.duplicate);
  }
  for (int i = 0; i < 100; ++i)
    ASSERT_EQ(verdict(picture), FrameVerdict::frozen);
  expect_recovery();
}

TEST_F(AFrame, OfARecordingMayStandStill) {
  FrameCheck recording(size, border, {.frozen_after = 0});
  const cv::Mat picture = scene();
  for (int i = 0; i < 100; ++i)
    ASSERT_EQ(recording.check(picture).verdict, FrameVerdict::good);
}

TEST_F(AFrame, IsTurnedWhenTheCameraWasTurnedOrMirrored) {
  watch();
  for (const int how : {-1, 0, 1}) {  // by 180 degrees, upside down, left to right
    for (int i = 0; i < 50; ++i) {
      cv::Mat picture;
      cv::flip(scene(i < 25 ? 1 : 0.7), picture, how);
      ASSERT_EQ(verdict(picture), FrameVerdict::turned) << how << ", " << i;
    }
    expect_recovery();
  }
}

TEST_F(AFrame, OfAnotherSceneIsNotTakenForATurnedOne) {
  watch();
  cv::Mat other(720, 1280, CV_8UC3);
  random_.fill(other, cv::RNG::UNIFORM, 0, 255);
  cv::resize(other(cv::Rect(0, 0, 16, 9)).clone(), other, other.size(), 0, 0, cv::INTER_NEAREST);
  for (int i = 0; i < 50; ++i)
    ASSERT_EQ(verdict(noisy(other)), FrameVerdict::good);
}

TEST_F(AFrame, TellsThatALampWasSwitchedForSomeFrames) {
  watch();
  FrameFindings findings = check_.check(scene(0.5));
  EXPECT_EQ(findings.verdict, FrameVerdict::good);
  EXPECT_GT(findings.desk_change, 0.9);
  EXPECT_TRUE(findings.settling);
  for (int i = 0; i < 6; ++i) {
    findings = check_.check(scene(0.5));
    EXPECT_LT(findings.desk_change, 0.1);
    EXPECT_TRUE(findings.settling) << i;
  }
  EXPECT_FALSE(check_.check(scene(0.5)).settling);
}

TEST_F(AFrame, DoesNotTakeAHandOrTheScreensFlashForALamp) {
  watch();
  cv::Mat hand = scene();
  cv::rectangle(hand, {300, 0, 450, 520}, cv::Scalar(90, 120, 180), cv::FILLED);
  FrameFindings findings = check_.check(hand);
  EXPECT_GT(findings.desk_change, 0.2);
  EXPECT_FALSE(findings.settling);
  cv::Mat flash = scene();
  flash.rowRange(535, 720).setTo(cv::Scalar::all(240));
  findings = check_.check(flash);
  EXPECT_FALSE(findings.settling);
}

TEST_F(AFrame, IsCheckedWithoutAllocating) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has its own heap";
  const std::array pictures{scene(), scene(), scene(0.5)};
  cv::Mat turned;
  cv::flip(pictures[0], turned, -1);
  const auto before = allocation_count();
  for (std::size_t i = 0; i < 200; ++i)
    check_.check(i % 50 == 49 ? turned : pictures[i % 3]);
  EXPECT_EQ(allocation_count() - before, 0U);
}

// Whatever the picture, there is an answer and the next good one counts again.
TEST_F(AFrame, OfAnyContentIsSurvived) {
  watch();
  for (int i = 0; i < 200; ++i) {
    cv::Mat picture = scene();
    const int first = random_.uniform(0, 720);
    const int last = random_.uniform(first, 721);
    cv::Mat part = picture.rowRange(first, last);
    if (i % 2 == 0) {
      random_.fill(part, cv::RNG::UNIFORM, 0, 256);
    } else {
      part.setTo(cv::Scalar::all(random_.uniform(0, 256)));
    }
    check_.check(picture);
    ASSERT_EQ(verdict(scene()), FrameVerdict::good) << i;
  }
}

}  // namespace
}  // namespace telehug
