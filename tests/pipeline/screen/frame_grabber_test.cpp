// SPDX-License-Identifier: Apache-2.0
#include "screen/frame_grabber.hpp"

#include <gmock/gmock.h>

#include "doubles/fake_clock.hpp"
#include "doubles/planned_frame_source.hpp"
#include "doubles/test_pictures.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

int shade_of(const ScreenPicture& picture) {
  return picture.bgr.at<cv::Vec3b>(0, 0)[0];
}

class FrameGrabberTest : public testing::Test {
 protected:
  FrameGrabber grabber_for(const FrameGrabberConfig& config) {
    auto made = std::make_unique<PlannedFrameSource>();
    made->picture = plain_picture(64, 48, {10, 0, 0});
    source = made.get();
    return {std::move(made), config, clock};
  }
  void show(int shade) { source->picture = plain_picture(64, 48, {static_cast<uchar>(shade), 0, 0}); }

  FakeClock clock;
  PlannedFrameSource* source = nullptr;
  ScreenPicture picture;
};

TEST_F(FrameGrabberTest, GivesTheWholeFrameAsTheMonitor) {
  FrameGrabber grabber = grabber_for({});
  ASSERT_TRUE(grabber.open());
  picture.in_front = true;
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(shade_of(picture), 10);
  EXPECT_EQ(picture.bgr.size(), cv::Size(64, 48));
  EXPECT_EQ(picture.origin_px, cv::Point(0, 0));
  EXPECT_EQ(picture.monitor.width_px, 64);
  EXPECT_EQ(picture.monitor.height_px, 48);
  EXPECT_EQ(picture.time, clock.now());
  EXPECT_EQ(picture.in_front, std::nullopt);
  EXPECT_EQ(grabber.name(), "screen through planned source");
  EXPECT_EQ(grabber.last_error(), "");
}

TEST_F(FrameGrabberTest, NeverWaits) {
  FrameGrabber grabber = grabber_for({});
  ASSERT_TRUE(grabber.open());
  for (const ReadOutcome outcome : {ReadOutcome::frame, ReadOutcome::timeout, ReadOutcome::lost}) {
    source->outcome = outcome;
    grabber.grab(picture);
  }
  EXPECT_EQ(source->longest_wait, Duration::zero());
}

TEST_F(FrameGrabberTest, SaysUnchangedWhileTheFramesAreEqual) {
  FrameGrabber grabber = grabber_for({});
  ASSERT_TRUE(grabber.open());
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  clock.advance(33ms);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
  EXPECT_EQ(picture.time, clock.now());

  source->picture.at<cv::Vec3b>(47, 63)[2] = 1;
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed) << "one level of the last pixel";
  EXPECT_EQ(picture.bgr.at<cv::Vec3b>(47, 63)[2], 1);
  show(10);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed) << "back to the first";
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
}

TEST_F(FrameGrabberTest, SaysUnchangedWhileNoFrameComes) {
  FrameGrabber grabber = grabber_for({});
  ASSERT_TRUE(grabber.open());
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  source->outcome = ReadOutcome::timeout;
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
  source->outcome = ReadOutcome::broken;
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
}

TEST_F(FrameGrabberTest, KeepsThePictureThatItLentWhileNothingChanges) {
  FrameGrabber grabber = grabber_for({});
  ASSERT_TRUE(grabber.open());
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  show(20);
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  for (int i = 0; i < 3; ++i)
    ASSERT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
  EXPECT_EQ(shade_of(picture), 20);
}

TEST_F(FrameGrabberTest, IsNeverUnchangedBeforeTheFirstFrame) {
  FrameGrabber grabber = grabber_for({});
  ASSERT_TRUE(grabber.open());
  source->outcome = ReadOutcome::timeout;
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  EXPECT_EQ(grabber.last_error(), "planned source has delivered no picture yet.");
  source->outcome = ReadOutcome::broken;
  source->error = "planned source: a damaged picture came";
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  EXPECT_EQ(grabber.last_error(), "planned source: a damaged picture came");
  source->outcome = ReadOutcome::frame;
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
}

TEST_F(FrameGrabberTest, TakesALiveDeviceThatFallsSilentForLost) {
  FrameGrabber grabber = grabber_for({});
  ASSERT_TRUE(grabber.open());
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  for (const ReadOutcome silence : {ReadOutcome::timeout, ReadOutcome::broken}) {
    source->outcome = silence;
    clock.advance(2s);
    EXPECT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
    clock.advance(1ms);
    EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
    EXPECT_THAT(grabber.last_error(), HasSubstr("planned source has delivered no picture for 2 s; check its cable"));
    source->outcome = ReadOutcome::frame;
    EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed) << "the same picture, but it was lost in between";
  }
}

TEST_F(FrameGrabberTest, LetsARecordingStandStillAsLongAsItLikes) {
  FrameGrabber grabber = grabber_for({.live = false});
  EXPECT_FALSE(grabber.is_live());
  ASSERT_TRUE(grabber.open());
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  source->outcome = ReadOutcome::timeout;
  clock.advance(1h);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
}

TEST_F(FrameGrabberTest, LooksOnlyAtItsRegion) {
  FrameGrabber grabber = grabber_for({.region = cv::Rect(20, 30, 30, 10)});
  EXPECT_TRUE(grabber.is_live());
  ASSERT_TRUE(grabber.open());
  EXPECT_EQ(source->needed, (RowRange{30, 40}));
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(30, 10));
  EXPECT_EQ(picture.origin_px, cv::Point(20, 30));
  EXPECT_EQ(picture.monitor.width_px, 64);

  show(20);
  source->picture(cv::Rect(20, 30, 30, 10)).setTo(cv::Scalar(10, 0, 0));
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::unchanged) << "all has changed but the region";
  source->picture.at<cv::Vec3b>(39, 49)[0] = 11;
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
}

TEST_F(FrameGrabberTest, CutsARegionThatReachesPastTheFrame) {
  constexpr int far = std::numeric_limits<int>::max();
  FrameGrabber grabber = grabber_for({.region = cv::Rect(-5, 40, far, far)});
  ASSERT_TRUE(grabber.open());
  EXPECT_EQ(source->needed, (RowRange{40, far}));
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(64, 8));
  EXPECT_EQ(picture.origin_px, cv::Point(0, 40));
}

TEST_F(FrameGrabberTest, RefusesARegionOutsideOfTheFrame) {
  for (const cv::Rect& region : {cv::Rect(64, 0, 10, 10), cv::Rect(0, 0, 0, 0), cv::Rect(5, 5, 3, -4)}) {
    FrameGrabber grabber = grabber_for({.region = region});
    ASSERT_TRUE(grabber.open());
    EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
    EXPECT_THAT(grabber.last_error(), HasSubstr("lies outside of the picture of planned source (64x48 px)"));
  }
}

TEST_F(FrameGrabberTest, NoticesThatTheDeviceHasChangedItsSize) {
  FrameGrabber grabber = grabber_for({.region = cv::Rect(0, 0, 32, 24)});
  ASSERT_TRUE(grabber.open());
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  source->picture = plain_picture(128, 72, {10, 0, 0});
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed) << "the region is equal, the monitor is not";
  EXPECT_EQ(picture.monitor.width_px, 128);
}

TEST_F(FrameGrabberTest, TellsInTheSourcesWordsWhatIsLostAndGetsItBack) {
  FrameGrabber grabber = grabber_for({});
  ASSERT_TRUE(grabber.open());
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  source->outcome = ReadOutcome::lost;
  source->error = "/dev/video9 is gone; plug it in again";
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  EXPECT_EQ(grabber.last_error(), "/dev/video9 is gone; plug it in again");
  source->outcome = ReadOutcome::timeout;
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost) << "there again, but without a picture";
  source->outcome = ReadOutcome::frame;
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
}

TEST_F(FrameGrabberTest, OpensLaterWhatCanNotBeOpenedNow) {
  FrameGrabber grabber = grabber_for({});
  source->can_open = false;
  const Status opened = grabber.open();
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().message, "The card is not plugged in.");
  EXPECT_FALSE(grabber.is_open());
  EXPECT_EQ(source->closes, 1) << "it must not go on looking for it by itself";
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  source->can_open = true;
  ASSERT_TRUE(grabber.open());
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
}

TEST_F(FrameGrabberTest, GivesNothingWhileClosedAndAllAfterOpeningAgain) {
  FrameGrabber grabber = grabber_for({});
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  EXPECT_EQ(grabber.last_error(), "screen through planned source is not open.");
  ASSERT_TRUE(grabber.open());
  ASSERT_TRUE(grabber.open());
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
  grabber.close();
  grabber.close();
  EXPECT_FALSE(grabber.is_open());
  EXPECT_FALSE(source->opened);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  ASSERT_TRUE(grabber.open());
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
}

}  // namespace
}  // namespace telehug
