// SPDX-License-Identifier: Apache-2.0
//
// FrameGrabber over the sources that it is used with: a V4L2 device and a recording.
#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "capture/recording.hpp"
#include "capture/webcam.hpp"
#include "doubles/fake_v4l2.hpp"
#include "doubles/test_pictures.hpp"
#include "screen/frame_grabber.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class FrameGrabberOfADeviceTest : public testing::Test {
 protected:
  void take(int blue) { device.take(jpeg_of(plain_picture(128, 72, {static_cast<uchar>(blue), 0, 0}))); }
  FrameGrabber grabber_for(const FrameGrabberConfig& config) {
    return {std::make_unique<Webcam>(WebcamSettings{"/dev/video0", {128, 72}, 30}, clock, device), config, clock};
  }

  FakeClock clock;
  FakeV4l2 device{clock};
  ScreenPicture picture;
};

TEST_F(FrameGrabberOfADeviceTest, TakesTheNewestOfSeveralWaitingFrames) {
  FrameGrabber grabber = grabber_for({});
  ASSERT_TRUE(grabber.open());
  for (const int blue : {50, 100, 200})
    take(blue);
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  EXPECT_NEAR(picture.bgr.at<cv::Vec3b>(0, 0)[0], 200, 3);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::unchanged) << "the older ones are not shown later";
  for (int i = 0; i < 3; ++i)
    take(200);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
  EXPECT_EQ(device.waits, 0);
}

TEST_F(FrameGrabberOfADeviceTest, SaysThatItIsUnpluggedAndGetsItBackWithoutWaiting) {
  FrameGrabber grabber = grabber_for({});
  ASSERT_TRUE(grabber.open());
  take(50);
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  device.unplug();
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  EXPECT_THAT(grabber.last_error(), AllOf(HasSubstr("/dev/video0 is gone"), HasSubstr("plug it in again")));
  const Timestamp unplugged = clock.now();
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  EXPECT_EQ(clock.now(), unplugged);

  device.plugged = true;
  clock.advance(500ms);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  take(50);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
  grabber.close();
  EXPECT_EQ(device.open_now, 0);
}

TEST_F(FrameGrabberOfADeviceTest, DecodesOnlyTheRegionsRows) {
  FrameGrabber grabber = grabber_for({.region = cv::Rect(0, 40, 128, 8)});
  ASSERT_TRUE(grabber.open());
  take(200);
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  const cv::Mat reference = plain_picture(128, 8, {200, 0, 0});
  EXPECT_LE(cv::norm(picture.bgr, reference, cv::NORM_INF), 3);
}

TEST_F(FrameGrabberOfADeviceTest, RefusesARegionBesideTheFrame) {
  FrameGrabber grabber = grabber_for({.region = cv::Rect(0, 500, 10, 10)});
  ASSERT_TRUE(grabber.open());
  take(200);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  EXPECT_THAT(grabber.last_error(), HasSubstr("webcam /dev/video0 (128x72 px)"));
}

TEST(FrameGrabberOfARecording, PlaysItAndSaysThatItIsOver) {
  FakeClock clock;
  const auto folder = std::filesystem::path(TELEHUG_FIXTURES) / "rig2";
  RecordingSettings settings;
  settings.folder = folder;
  int sleeps = 0;
  FrameGrabber grabber(std::make_unique<Recording>(settings, clock, [&](Timestamp) { ++sleeps; }), {.live = false},
                       clock);
  ASSERT_TRUE(grabber.open());
  ScreenPicture picture;
  int changed = 0;
  GrabOutcome outcome = grabber.grab(picture);
  for (; outcome != GrabOutcome::lost && changed < 100; clock.advance(5ms), outcome = grabber.grab(picture)) {
    if (outcome == GrabOutcome::changed) ++changed;
  }
  EXPECT_EQ(changed, 14) << "pictures in the recording, each other than the one before";
  EXPECT_EQ(grabber.last_error(),
            "The recording is over (recording " + folder.string() + "); choose another or open it again.");
  EXPECT_EQ(sleeps, 0);

  grabber.close();
  ASSERT_TRUE(grabber.open());
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
}

}  // namespace
}  // namespace telehug
