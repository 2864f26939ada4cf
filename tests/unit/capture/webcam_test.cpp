// SPDX-License-Identifier: Apache-2.0
#include "capture/webcam.hpp"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "doubles/fake_v4l2.hpp"
#include "doubles/test_pictures.hpp"

namespace telehug {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class AWebcam : public ::testing::Test {
 protected:
  static std::vector<std::uint8_t> jpeg(uchar blue = 200) { return jpeg_of(plain_picture(128, 72, {blue, 100, 50})); }

  void take_soon(std::vector<std::uint8_t> picture) {
    device_.while_waiting = [this, picture = std::move(picture)] {
      clock_.advance(5ms);
      device_.take(picture);
    };
  }
  ReadOutcome read_one(const std::vector<std::uint8_t>& picture) {
    device_.take(picture);
    return webcam_.read(frame_, 100ms);
  }
  std::string why_not_open() {
    const Status opened = webcam_.open();
    return opened.ok() ? "" : opened.error().message;
  }

  FakeClock clock_;
  FakeV4l2 device_{clock_};
  Webcam webcam_{{"/dev/video0", {128, 72}, 30}, clock_, device_};
  Frame frame_;
};

TEST_F(AWebcam, DeliversMjpegWithTheKernelsTimeOfTaking) {
  ASSERT_TRUE(webcam_.open());
  EXPECT_EQ(webcam_.size().width_px, 128);
  EXPECT_EQ(webcam_.mode(), "128x72 MJPG, 30 fps");
  const Timestamp taken = clock_.now();
  device_.take(jpeg());
  clock_.advance(12ms);
  ASSERT_EQ(webcam_.read(frame_, 100ms), ReadOutcome::frame);
  EXPECT_EQ(frame_.time, taken);
  EXPECT_EQ(frame_.bgr.size(), cv::Size(128, 72));
  EXPECT_NEAR(frame_.bgr.at<cv::Vec3b>(30, 30)[0], 200, 3);
  EXPECT_NEAR(frame_.bgr.at<cv::Vec3b>(30, 30)[2], 50, 3);
}

TEST_F(AWebcam, DeliversMjpegWithoutHuffmanTables) {
  ASSERT_TRUE(webcam_.open());
  EXPECT_EQ(read_one(without_huffman_tables(jpeg())), ReadOutcome::frame);
}

TEST_F(AWebcam, FallsBackToYuyvAndConvertsItsColours) {
  device_.formats = {V4L2_PIX_FMT_H264, V4L2_PIX_FMT_YUYV};
  ASSERT_TRUE(webcam_.open());
  EXPECT_EQ(webcam_.mode(), "128x72 YUYV, 30 fps");
  // BT.601, limited range: red (255, 0, 0) is Y 81, U 90, V 240; white is Y 235, U 128, V 128; black Y 16.
  std::vector<std::uint8_t> picture;
  for (int i = 0; i < 64 * 72; ++i) {
    const bool left = i % 64 < 32;
    for (const int byte : left ? std::array{81, 90, 81, 240} : std::array{235, 128, 16, 128}) {
      picture.push_back(static_cast<std::uint8_t>(byte));
    }
  }
  ASSERT_EQ(read_one(picture), ReadOutcome::frame);
  const auto colour_near = [](const cv::Vec3b& colour, int blue, int green, int red) {
    return std::abs(colour[0] - blue) <= 2 && std::abs(colour[1] - green) <= 2 && std::abs(colour[2] - red) <= 2;
  };
  EXPECT_TRUE(colour_near(frame_.bgr.at<cv::Vec3b>(70, 3), 0, 0, 255)) << frame_.bgr.at<cv::Vec3b>(70, 3);
  EXPECT_TRUE(colour_near(frame_.bgr.at<cv::Vec3b>(70, 100), 255, 255, 255));
  EXPECT_TRUE(colour_near(frame_.bgr.at<cv::Vec3b>(70, 101), 0, 0, 0));
}

TEST_F(AWebcam, FillsOnlyTheRowsThatAreNeededUntilAllAreAgain) {
  for (const std::uint32_t format : {V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_YUYV}) {
    device_.formats = {format};
    ASSERT_TRUE(webcam_.open());
    const auto picture = [&](uchar grey) {
      return format == V4L2_PIX_FMT_MJPEG ? jpeg_of(plain_picture(128, 72, {grey, grey, grey}))
                                          : std::vector<std::uint8_t>(std::size_t{2 * 128 * 72}, grey);
    };
    ASSERT_EQ(read_one(picture(128)), ReadOutcome::frame);
    EXPECT_EQ(frame_.rows, RowRange{});
    const cv::Mat before = frame_.bgr.clone();
    webcam_.need_rows({48});
    ASSERT_EQ(read_one(picture(30)), ReadOutcome::frame);
    EXPECT_EQ(frame_.rows, RowRange{48});
    EXPECT_EQ(cv::norm(frame_.bgr.rowRange(0, 48), before.rowRange(0, 48), cv::NORM_INF), 0);
    EXPECT_GT(cv::norm(frame_.bgr.row(48), before.row(48), cv::NORM_INF), 50);
    EXPECT_GT(cv::norm(frame_.bgr.row(71), before.row(71), cv::NORM_INF), 50);
    webcam_.need_rows({});
    ASSERT_EQ(read_one(picture(30)), ReadOutcome::frame);
    EXPECT_EQ(frame_.rows, RowRange{});
    EXPECT_GT(cv::norm(frame_.bgr.row(0), before.row(0), cv::NORM_INF), 50);
    webcam_.close();
  }
}

TEST_F(AWebcam, CountsAPictureThatIsDamagedInTheRowsThatAreNeeded) {
  ASSERT_TRUE(webcam_.open());
  webcam_.need_rows({48});
  auto cut = jpeg_of(sloping_picture(128, 72));
  ASSERT_GT(cut.size(), 20U);
  cut.erase(cut.end() - 20, cut.end());
  EXPECT_EQ(read_one(cut), ReadOutcome::broken);
  EXPECT_EQ(read_one(jpeg()), ReadOutcome::frame);
  EXPECT_EQ(webcam_.broken_frames(), 1u);
}

TEST_F(AWebcam, TakesTheNearestSizeAndSaysSo) {
  device_.sizes = {{64, 48}};
  device_.fps = 15;
  ASSERT_TRUE(webcam_.open());
  EXPECT_EQ(webcam_.size().width_px, 64);
  EXPECT_EQ(webcam_.mode(), "64x48 MJPG, 15 fps (nearest to 128x72, 30 fps)");
}

TEST_F(AWebcam, ReadsTheNewestOfSeveralPicturesAndCountsTheOthers) {
  ASSERT_TRUE(webcam_.open());
  ASSERT_EQ(read_one(jpeg(10)), ReadOutcome::frame);
  const auto first = frame_.sequence;
  device_.take(jpeg(20));
  device_.take(jpeg(30));
  device_.take(jpeg(240));
  ASSERT_EQ(webcam_.read(frame_, 100ms), ReadOutcome::frame);
  EXPECT_NEAR(frame_.bgr.at<cv::Vec3b>(30, 30)[0], 240, 3);
  EXPECT_EQ(frame_.sequence, first + 3);
  EXPECT_EQ(webcam_.skipped_frames(), 2u);
  EXPECT_EQ(device_.queued(), 4u);
}

TEST_F(AWebcam, ShowsPicturesThatTheDriverLostAsAGap) {
  ASSERT_TRUE(webcam_.open());
  ASSERT_EQ(read_one(jpeg()), ReadOutcome::frame);
  const auto first = frame_.sequence;
  for (int i = 0; i < 10; ++i)
    device_.take(jpeg());  // four find a buffer
  ASSERT_EQ(webcam_.read(frame_, 100ms), ReadOutcome::frame);
  EXPECT_EQ(frame_.sequence, first + 4);
  ASSERT_EQ(read_one(jpeg()), ReadOutcome::frame);
  EXPECT_EQ(frame_.sequence, first + 11);
}

TEST_F(AWebcam, GivesEveryBufferBack) {
  ASSERT_TRUE(webcam_.open());
  for (int i = 0; i < 50; ++i) {
    ASSERT_EQ(read_one(i % 3 == 0 ? std::vector<std::uint8_t>{1, 2, 3} : jpeg()),
              i % 3 == 0 ? ReadOutcome::broken : ReadOutcome::frame);
    ASSERT_EQ(device_.queued(), 4u);
  }
}

TEST_F(AWebcam, WaitsForAPictureWithoutSpinning) {
  ASSERT_TRUE(webcam_.open());
  take_soon(jpeg());
  ASSERT_EQ(webcam_.read(frame_, 100ms), ReadOutcome::frame);
  EXPECT_EQ(device_.waits, 1);
  const Timestamp before = clock_.now();
  EXPECT_EQ(webcam_.read(frame_, 100ms), ReadOutcome::timeout);
  EXPECT_EQ(clock_.now() - before, 100ms);
  EXPECT_EQ(device_.waits, 2);
}

TEST_F(AWebcam, CountsBrokenPicturesAndDeliversTheNextGoodOne) {
  ASSERT_TRUE(webcam_.open());
  auto cut = jpeg_of(sloping_picture(128, 72));
  cut.resize(cut.size() / 2);
  EXPECT_EQ(read_one(cut), ReadOutcome::broken);
  EXPECT_THAT(webcam_.last_error(), HasSubstr("damaged JPEG"));
  EXPECT_EQ(read_one({}), ReadOutcome::broken);
  EXPECT_EQ(read_one(jpeg_of(plain_picture(64, 48, {1, 2, 3}))), ReadOutcome::broken);
  EXPECT_THAT(webcam_.last_error(), HasSubstr("64x48"));
  device_.take(jpeg(), V4L2_BUF_FLAG_ERROR);
  EXPECT_EQ(webcam_.read(frame_, 100ms), ReadOutcome::broken);
  EXPECT_THAT(webcam_.last_error(), HasSubstr("damaged on its way"));
  EXPECT_EQ(webcam_.broken_frames(), 4u);
  EXPECT_EQ(read_one(jpeg()), ReadOutcome::frame);
}

TEST_F(AWebcam, IsSetUpAgainWhenItsPicturesHaveAnotherSizeForGood) {
  ASSERT_TRUE(webcam_.open());
  const auto odd = jpeg_of(plain_picture(64, 48, {1, 2, 3}));
  for (int i = 0; i < 14; ++i)
    ASSERT_EQ(read_one(odd), ReadOutcome::broken);
  ASSERT_EQ(read_one(jpeg()), ReadOutcome::frame);
  for (int i = 0; i < 14; ++i)
    ASSERT_EQ(read_one(odd), ReadOutcome::broken);
  ASSERT_EQ(read_one(odd), ReadOutcome::lost);
  EXPECT_THAT(webcam_.last_error(), HasSubstr("another size"));
  EXPECT_EQ(webcam_.read(frame_, 600ms), ReadOutcome::timeout);
  EXPECT_EQ(device_.opened, 2);
  EXPECT_EQ(read_one(jpeg()), ReadOutcome::frame);
}

TEST_F(AWebcam, TakesAShortYuyvPictureForBroken) {
  device_.formats = {V4L2_PIX_FMT_YUYV};
  ASSERT_TRUE(webcam_.open());
  EXPECT_EQ(read_one(std::vector<std::uint8_t>(2 * 128 * 71, 128)), ReadOutcome::broken);
  EXPECT_EQ(read_one(std::vector<std::uint8_t>(2 * 128 * 72, 128)), ReadOutcome::frame);
}

TEST_F(AWebcam, UsesItsOwnClockWhenTheKernelsTimeIsNoMonotonicOne) {
  device_.time_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  ASSERT_TRUE(webcam_.open());
  device_.take(jpeg());
  clock_.advance(7ms);
  ASSERT_EQ(webcam_.read(frame_, 100ms), ReadOutcome::frame);
  EXPECT_EQ(frame_.time, clock_.now());
}

TEST_F(AWebcam, ThatDeliversNothingAnyMoreIsLostAndSetUpAgain) {
  ASSERT_TRUE(webcam_.open());
  ASSERT_EQ(read_one(jpeg()), ReadOutcome::frame);
  EXPECT_EQ(webcam_.read(frame_, 4900ms), ReadOutcome::timeout);
  ASSERT_EQ(read_one(jpeg()), ReadOutcome::frame);
  EXPECT_EQ(webcam_.read(frame_, 4900ms), ReadOutcome::timeout);
  EXPECT_EQ(webcam_.read(frame_, 200ms), ReadOutcome::lost);
  EXPECT_THAT(webcam_.last_error(), AllOf(HasSubstr("/dev/video0"), HasSubstr("no pictures"), HasSubstr("plug it in")));
  EXPECT_FALSE(device_.streaming);
  EXPECT_EQ(webcam_.read(frame_, 600ms), ReadOutcome::timeout);
  EXPECT_TRUE(device_.streaming);
  EXPECT_EQ(read_one(jpeg()), ReadOutcome::frame);
}

TEST_F(AWebcam, IsLostWhenUnpluggedAndComesBackWhenPluggedInAgain) {
  ASSERT_TRUE(webcam_.open());
  ASSERT_EQ(read_one(jpeg()), ReadOutcome::frame);
  const auto last = frame_.sequence;
  device_.while_waiting = [this] { device_.unplug(); };
  EXPECT_EQ(webcam_.read(frame_, 100ms), ReadOutcome::lost);
  EXPECT_THAT(webcam_.last_error(), AllOf(HasSubstr("/dev/video0 is gone"), HasSubstr("plug it in")));
  EXPECT_FALSE(webcam_.is_open());
  EXPECT_EQ(device_.open_now, 0);
  EXPECT_EQ(device_.mapped_now, 0);

  const Timestamp lost = clock_.now();
  EXPECT_EQ(webcam_.read(frame_, 200ms), ReadOutcome::lost);
  EXPECT_EQ(clock_.now() - lost, 200ms);
  device_.plugged = true;
  EXPECT_EQ(webcam_.read(frame_, 200ms), ReadOutcome::lost);
  EXPECT_EQ(device_.opened, 1);  // not before 500 ms
  EXPECT_EQ(webcam_.read(frame_, 200ms), ReadOutcome::timeout);
  EXPECT_EQ(clock_.now() - lost, 500ms);
  EXPECT_EQ(device_.opened, 2);
  ASSERT_EQ(read_one(jpeg()), ReadOutcome::frame);
  EXPECT_GT(frame_.sequence, last);
}

TEST_F(AWebcam, LooksForALostCameraAtMostEvery500Ms) {
  device_.plugged = false;
  EXPECT_THAT(why_not_open(), HasSubstr("there is no webcam /dev/video0"));
  device_.waits = 0;
  const Timestamp before = clock_.now();
  while (clock_.now() - before < 10s)
    EXPECT_EQ(webcam_.read(frame_, 10s), ReadOutcome::lost);
  EXPECT_EQ(device_.waits, 20);
}

TEST_F(AWebcam, NoticesThatItWasUnpluggedBetweenTwoReads) {
  ASSERT_TRUE(webcam_.open());
  device_.take(jpeg());
  device_.unplug();
  EXPECT_EQ(webcam_.read(frame_, 100ms), ReadOutcome::lost);
  EXPECT_EQ(device_.mapped_now, 0);
}

TEST_F(AWebcam, IsReleasedByCloseAndStaysClosed) {
  ASSERT_TRUE(webcam_.open());
  EXPECT_TRUE(device_.streaming);
  EXPECT_EQ(device_.mapped_now, 4);
  webcam_.close();
  EXPECT_FALSE(device_.streaming);
  EXPECT_EQ(device_.mapped_now, 0);
  EXPECT_EQ(device_.open_now, 0);
  EXPECT_EQ(webcam_.read(frame_, 5s), ReadOutcome::lost);
  EXPECT_EQ(device_.opened, 1);
  EXPECT_THAT(webcam_.last_error(), HasSubstr("closed"));
}

TEST_F(AWebcam, IsReleasedWithItsOwner) {
  {
    Webcam other({"/dev/video0", {128, 72}, 30}, clock_, device_);
    ASSERT_TRUE(other.open());
    ASSERT_TRUE(other.open());
    EXPECT_EQ(device_.opened, 1);
  }
  EXPECT_EQ(device_.open_now, 0);
  EXPECT_EQ(device_.mapped_now, 0);
}

TEST_F(AWebcam, TellsWhatToDoAboutMissingPermission) {
  device_.open_error = EACCES;
  EXPECT_THAT(why_not_open(), AllOf(HasSubstr("/dev/video0"), HasSubstr("group 'video'")));
}

TEST_F(AWebcam, NamesTheDeviceThatAnotherProgramUses) {
  device_.busy = true;
  EXPECT_THAT(why_not_open(), AllOf(HasSubstr("/dev/video0"), HasSubstr("used by another program")));
  EXPECT_EQ(device_.open_now, 0);
  device_.busy = false;
  EXPECT_TRUE(webcam_.open());
}

TEST_F(AWebcam, RefusesADeviceThatDeliversNoPictures) {
  device_.capabilities = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  EXPECT_THAT(why_not_open(), AllOf(HasSubstr("delivers no pictures"), HasSubstr("video-index0")));
}

TEST_F(AWebcam, NamesTheFormatsThatItCantUse) {
  device_.formats = {V4L2_PIX_FMT_H264};
  EXPECT_THAT(why_not_open(), HasSubstr("H264"));
}

TEST_F(AWebcam, RefusesSizesThatAreNoPictures) {
  device_.sizes = {{0, 0}};
  EXPECT_THAT(why_not_open(), HasSubstr("0x0"));
}

TEST_F(AWebcam, RefusesADriverThatGrantsTooFewBuffers) {
  device_.buffers_granted = 1;
  EXPECT_THAT(why_not_open(), HasSubstr("buffers"));
  EXPECT_EQ(device_.open_now, 0);
}

}  // namespace
}  // namespace telehug
