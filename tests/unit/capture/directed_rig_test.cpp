// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/directed_rig.hpp"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "doubles/fake_clock.hpp"
#include "doubles/temporary_folder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;

VirtualRigSettings small_rig() {
  VirtualRigSettings settings;
  settings.image = {640, 360};
  settings.focal_px = 550;
  settings.noise_sd = 0;
  settings.content = ScreenContent::black;
  return settings;
}

class DirectedRigTest : public ::testing::Test {
 protected:
  DirectedRigTest() { EXPECT_TRUE(rig_.open().ok()); }

  cv::Mat picture() {
    clock_.advance(40ms);
    const ReadOutcome outcome = rig_.read(frame_, 50ms);
    EXPECT_EQ(outcome, ReadOutcome::frame) << rig_.last_error();
    return frame_.bgr.clone();
  }
  // As another program does it: nobody sees half of the file.
  void put(const char* name, std::string_view content) {
    const auto beside = folder_.write("beside", content);
    std::filesystem::rename(beside, folder_ / name);
  }
  void show(const cv::Scalar& colour) {
    ASSERT_TRUE(write_png(folder_ / "screen.png", cv::Mat(100, 120, CV_8UC3, colour)).ok());
  }
  // Of the pixel that looks at the middle of the screen.
  static cv::Vec3b middle(const cv::Mat& bgr) { return bgr.at<cv::Vec3b>(343, 320); }

  FakeClock clock_;
  TemporaryFolder folder_;
  DirectedRig rig_{small_rig(), folder_.path(), clock_,
                   [this](Timestamp time) { clock_.advance(time - clock_.now()); }};
  Frame frame_;
};

TEST_F(DirectedRigTest, ShowsWhatTheSettingsSayWithNobodyThereUntilItIsDirected) {
  const cv::Mat before = picture();
  EXPECT_LT(middle(before)[1], 60);
  EXPECT_EQ(cv::norm(before, picture(), cv::NORM_INF), 0);
}

TEST_F(DirectedRigTest, ShowsThePictureInItsFolderFromTheNextFrameOn) {
  const cv::Mat before = picture();
  show({255, 255, 255});
  const cv::Mat white = picture();
  EXPECT_GT(middle(white)[1], 150);
  show({0, 0, 255});
  const cv::Vec3b red = middle(picture());
  EXPECT_GT(red[2], red[0] + 60);
  std::filesystem::remove(folder_ / "screen.png");
  EXPECT_EQ(cv::norm(before, picture(), cv::NORM_INF), 0);
}

TEST_F(DirectedRigTest, MovesTheHandFromThePictureOnInWhichItWasTold) {
  const cv::Mat nobody = picture();
  put("hand.csv", "t_s,x_mm,y_mm,hover_mm\n0,190,200,0\n0.1,190,200,0\n");
  EXPECT_GT(cv::norm(nobody, picture(), cv::NORM_INF), 20);
  for (int i = 0; i < 2; ++i)
    EXPECT_GT(cv::norm(nobody, picture(), cv::NORM_INF), 20) << i;
  EXPECT_EQ(cv::norm(nobody, picture(), cv::NORM_INF), 0) << "0.1 s are over";
  put("hand.csv", "t_s,x_mm,y_mm,hover_mm\n0,150,200,0\n9,150,200,0\n");
  EXPECT_GT(cv::norm(nobody, picture(), cv::NORM_INF), 20);
}

TEST_F(DirectedRigTest, SaysWhichFileIsWrongUntilItIsMended) {
  put("hand.csv", "t_s,x_mm,y_mm,hover_mm\n0,190,200,-1\n");
  clock_.advance(40ms);
  EXPECT_EQ(rig_.read(frame_, 50ms), ReadOutcome::broken);
  EXPECT_THAT(rig_.last_error(), HasSubstr("hand.csv:2: hover_mm"));
  clock_.advance(40ms);
  EXPECT_EQ(rig_.read(frame_, 50ms), ReadOutcome::broken);
  std::filesystem::remove(folder_ / "hand.csv");
  (void)picture();
  put("screen.png", "no picture");
  clock_.advance(40ms);
  EXPECT_EQ(rig_.read(frame_, 50ms), ReadOutcome::broken);
  EXPECT_THAT(rig_.last_error(), HasSubstr("screen.png"));
}

TEST_F(DirectedRigTest, KeepsToTheClockAndCountsOnAfterItWasClosed) {
  (void)picture();
  EXPECT_EQ(frame_.sequence, 1u) << "the newest one wins";
  EXPECT_EQ(rig_.read(frame_, 1ms), ReadOutcome::timeout);
  rig_.close();
  EXPECT_EQ(rig_.read(frame_, 1ms), ReadOutcome::lost);
  ASSERT_TRUE(rig_.open().ok());
  EXPECT_EQ(rig_.read(frame_, 50ms), ReadOutcome::frame);
  EXPECT_EQ(frame_.sequence, 2u);
  EXPECT_EQ(frame_.time, clock_.now());
}

}  // namespace
}  // namespace telehug
