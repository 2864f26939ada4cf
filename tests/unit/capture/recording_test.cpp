// SPDX-License-Identifier: Apache-2.0
#include "capture/recording.hpp"

#include <gmock/gmock.h>

#include "doubles/fake_clock.hpp"
#include "doubles/temporary_folder.hpp"
#include "doubles/test_pictures.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;

// Four pictures at 0, 100, 250 and 300 ms; the blue of picture n is 10 n.
class ARecording : public ::testing::Test {
 protected:
  ARecording() {
    for (int i = 1; i <= 4; ++i) {
      const auto blue = static_cast<uchar>(10 * i);
      std::filesystem::create_directories(folder_ / "sequence");
      EXPECT_TRUE(write_png(folder_ / ("sequence/" + std::to_string(i) + ".png"), plain_picture(8, 8, {blue, 0, 0})));
    }
    folder_.write("rig.toml", "width_mm = 380\nheight_mm = 300\nresolution = [1280, 1024]\n");
    folder_.write("sequence/times.csv", "frame,monotonic_ns\n1,5000000000\n2,5100000000\n3,5250000000\n4,5300000000\n");
  }

  Recording recording(bool real_time, bool loop) {
    RecordingSettings settings;
    settings.folder = folder_.path();
    settings.real_time = real_time;
    settings.loop = loop;
    return Recording(settings, clock_, [this](Timestamp until) {
      EXPECT_GT(until, clock_.now());
      ++sleeps_;
      clock_.advance(until - clock_.now());
    });
  }

  static int picture_in(const Frame& frame) { return frame.bgr.at<cv::Vec3b>(0, 0)[0] / 10; }

  TemporaryFolder folder_;
  FakeClock clock_;
  Timestamp begin_ = clock_.now();
  int sleeps_ = 0;
  Frame frame_;
};

TEST_F(ARecording, GivesEveryPictureAtItsTime) {
  Recording source = recording(true, false);
  ASSERT_TRUE(source.open());
  EXPECT_EQ(source.size().width_px, 8);
  int picture = 0;
  for (const Duration due : {0ms, 100ms, 250ms, 300ms}) {
    ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
    EXPECT_EQ(picture_in(frame_), ++picture);
    EXPECT_EQ(source.frame_name(), std::to_string(picture));
    EXPECT_EQ(clock_.now() - begin_, due);
    EXPECT_EQ(frame_.time, begin_ + due);
    EXPECT_EQ(frame_.sequence, static_cast<std::uint64_t>(picture - 1));
  }
  EXPECT_EQ(source.read(frame_, 1s), ReadOutcome::ended);
  EXPECT_EQ(source.read(frame_, 1s), ReadOutcome::ended);
}

TEST_F(ARecording, WaitsNoLongerThanItIsAllowedTo) {
  Recording source = recording(true, false);
  ASSERT_TRUE(source.open());
  ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  EXPECT_EQ(source.read(frame_, 60ms), ReadOutcome::timeout);
  EXPECT_EQ(clock_.now() - begin_, 60ms);
  EXPECT_EQ(sleeps_, 1);
  EXPECT_EQ(source.read(frame_, 60ms), ReadOutcome::frame);
  EXPECT_EQ(clock_.now() - begin_, 100ms);
}

TEST_F(ARecording, GivesALateReaderTheNewestPictureAndShowsTheGap) {
  Recording source = recording(true, false);
  ASSERT_TRUE(source.open());
  clock_.advance(260ms);
  ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  EXPECT_EQ(picture_in(frame_), 3);
  EXPECT_EQ(frame_.sequence, 2u);
  EXPECT_EQ(frame_.time, begin_ + 250ms);
  clock_.advance(10s);
  ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  EXPECT_EQ(picture_in(frame_), 4);
  EXPECT_EQ(source.read(frame_, 1s), ReadOutcome::ended);
}

TEST_F(ARecording, BeginsAgainInALoopAfterTheUsualPause) {
  Recording source = recording(true, true);
  ASSERT_TRUE(source.open());
  for (int i = 0; i < 4; ++i)
    ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  EXPECT_EQ(picture_in(frame_), 1);
  EXPECT_EQ(frame_.sequence, 4u);
  EXPECT_EQ(clock_.now() - begin_, 400ms);  // 300 ms and the mean distance of two pictures
}

TEST_F(ARecording, NeverWaitsAndLeavesNothingOutWhenNotInRealTime) {
  Recording source = recording(false, false);
  ASSERT_TRUE(source.open());
  clock_.advance(10s);
  for (int picture = 1; picture <= 4; ++picture) {
    ASSERT_EQ(source.read(frame_, 0ms), ReadOutcome::frame);
    EXPECT_EQ(picture_in(frame_), picture);
  }
  EXPECT_EQ(frame_.time, begin_ + 300ms);
  EXPECT_EQ(source.read(frame_, 0ms), ReadOutcome::ended);
  EXPECT_EQ(sleeps_, 0);
}

TEST_F(ARecording, BeginsAnewWhenItIsOpenedAgainAndCountsOn) {
  Recording source = recording(true, false);
  ASSERT_TRUE(source.open());
  ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  source.close();
  EXPECT_FALSE(source.is_open());
  EXPECT_EQ(source.read(frame_, 10ms), ReadOutcome::lost);
  ASSERT_TRUE(source.open());
  const Timestamp again = clock_.now();
  ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  EXPECT_EQ(picture_in(frame_), 1);
  EXPECT_EQ(frame_.time, again);
  EXPECT_EQ(frame_.sequence, 2u);
}

TEST_F(ARecording, SaysWhichPictureIsBrokenAndGoesOn) {
  folder_.write("sequence/2.png", "not a picture");
  Recording source = recording(true, false);
  ASSERT_TRUE(source.open());
  ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  EXPECT_EQ(source.read(frame_, 1s), ReadOutcome::broken);
  EXPECT_THAT(source.last_error(), HasSubstr("sequence/2.png"));
  ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  EXPECT_EQ(picture_in(frame_), 3);
  EXPECT_EQ(frame_.sequence, 2u);
}

TEST_F(ARecording, ThatCantBeReadIsLookedForAgainEvery500Ms) {
  std::filesystem::rename(folder_ / "sequence", folder_ / "elsewhere");
  Recording source = recording(true, false);
  const Status opened = source.open();
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("has no part"));
  EXPECT_EQ(source.read(frame_, 100ms), ReadOutcome::lost);
  EXPECT_EQ(clock_.now() - begin_, 100ms);
  std::filesystem::rename(folder_ / "elsewhere", folder_ / "sequence");
  EXPECT_EQ(source.read(frame_, 300ms), ReadOutcome::lost);
  EXPECT_FALSE(source.is_open());
  EXPECT_NE(source.read(frame_, 300ms), ReadOutcome::lost);
  EXPECT_TRUE(source.is_open());
  EXPECT_EQ(clock_.now() - begin_, 500ms);
}

TEST_F(ARecording, FillsOnlyTheRowsOfAJpegThatAreNeeded) {
  const TemporaryFolder jpegs;
  for (const char* const name : {"1.jpg", "2.jpg"})
    ASSERT_TRUE(write_jpeg(jpegs / name, plain_picture(64, 64, {200, 200, 200})));
  RecordingSettings settings;
  settings.folder = jpegs.path();
  settings.real_time = false;
  Recording source(settings, clock_);
  ASSERT_TRUE(source.open());
  source.need_rows({32, 48});
  ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  EXPECT_EQ(frame_.rows, (RowRange{32, 48}));
  EXPECT_EQ(frame_.bgr.at<cv::Vec3b>(16, 16)[0], 0);
  EXPECT_NEAR(frame_.bgr.at<cv::Vec3b>(40, 16)[0], 200, 3);
  source.need_rows({});
  ASSERT_EQ(source.read(frame_, 1s), ReadOutcome::frame);
  EXPECT_EQ(frame_.rows, RowRange{});
  EXPECT_NEAR(frame_.bgr.at<cv::Vec3b>(16, 16)[0], 200, 3);
}

TEST_F(ARecording, MayBeAPlainFolderOfPicturesAt30FramesASecond) {
  std::filesystem::remove(folder_ / "sequence/times.csv");
  RecordingSettings settings;
  settings.folder = folder_ / "sequence";
  settings.real_time = false;
  Recording source(settings, clock_);
  ASSERT_TRUE(source.open());
  for (int i = 0; i < 4; ++i)
    ASSERT_EQ(source.read(frame_, 0ms), ReadOutcome::frame);
  EXPECT_NEAR(to_ms(frame_.time - begin_), 100, 0.001);
}

TEST(Recording, ReplaysTheSampleGesture) {
  FakeClock clock;
  RecordingSettings settings;
  settings.folder = TELEHUG_FIXTURES "/rig2";
  settings.real_time = false;
  Recording source(settings, clock);
  ASSERT_TRUE(source.open());
  Frame frame;
  int frames = 0;
  while (source.read(frame, 0ms) == ReadOutcome::frame)
    ++frames;
  EXPECT_EQ(frames, 14);
  EXPECT_EQ(frame.bgr.cols, 1280);
}

}  // namespace
}  // namespace telehug
