// SPDX-License-Identifier: Apache-2.0
//
// Frames of which only some rows were filled.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "capture/frame_check.hpp"
#include "doubles/checked_frames.hpp"

namespace telehug {
namespace {

// A source that fills only the rows that are needed, as long as whole pictures are not wanted.
class AFrameOfSomeRows : public AFrame {
 protected:
  FrameFindings see(const cv::Mat& picture) {
    const RowRange filled = check_.wants_whole_pictures() ? RowRange{} : RowRange{300};
    const RowRange inside = filled.within(size.height_px);
    picture.rowRange(inside.first, inside.end).copyTo(held_.rowRange(inside.first, inside.end));
    return check_.check(held_, filled);
  }
  void watch(int frames = 40) {
    for (int i = 0; i < frames; ++i)
      ASSERT_EQ(see(scene()).verdict, FrameVerdict::good);
    ASSERT_FALSE(check_.wants_whole_pictures());
  }

  cv::Mat held_ = cv::Mat::zeros(size.height_px, size.width_px, CV_8UC3);
};

TEST_F(AFrameOfSomeRows, IsWantedWholeUntilItIsKnownHowGoodOnesLook) {
  for (int i = 0; i < 30; ++i) {
    EXPECT_TRUE(check_.wants_whole_pictures());
    EXPECT_EQ(check_.check(scene(), {300}).verdict, FrameVerdict::good) << "some rows are better than nothing";
  }
  for (int i = 0; i < 30; ++i) {
    EXPECT_TRUE(check_.wants_whole_pictures()) << i;
    EXPECT_EQ(see(scene()).verdict, FrameVerdict::good);
  }
  EXPECT_FALSE(check_.wants_whole_pictures());
}

TEST_F(AFrameOfSomeRows, IsGoodWhateverTheOtherRowsHold) {
  watch();
  for (int i = 0; i < 20; ++i) {
    cv::Mat above = held_.rowRange(0, 300);
    random_.fill(above, cv::RNG::UNIFORM, 0, i % 2 == 0 ? 256 : 1);
    const FrameFindings findings = see(scene());
    ASSERT_EQ(findings.verdict, FrameVerdict::good);
    ASSERT_FALSE(findings.duplicate);
    ASSERT_LT(findings.desk_change, 0.05);
    ASSERT_FALSE(check_.wants_whole_pictures());
  }
}

TEST_F(AFrameOfSomeRows, IsBlankTornOrFrozenInThem) {
  watch();
  EXPECT_EQ(see(cv::Mat(size.height_px, size.width_px, CV_8UC3, cv::Scalar::all(0))).verdict, FrameVerdict::blank);
  cv::Mat unfilled = scene();
  unfilled.rowRange(620, 720).setTo(cv::Scalar(128, 128, 128));
  EXPECT_EQ(see(unfilled).verdict, FrameVerdict::torn);
  watch(10);
  const cv::Mat before = scene();
  ASSERT_EQ(see(before).verdict, FrameVerdict::good);
  cv::Mat half = scene();
  before.rowRange(500, 720).copyTo(half.rowRange(500, 720));
  EXPECT_EQ(see(half).verdict, FrameVerdict::torn);
  const cv::Mat still = scene();
  ASSERT_EQ(see(still).verdict, FrameVerdict::good);
  for (int i = 1; i < 15; ++i)
    ASSERT_TRUE(see(still).duplicate);
  EXPECT_EQ(see(still).verdict, FrameVerdict::frozen);
  EXPECT_EQ(see(scene()).verdict, FrameVerdict::good);
}

TEST_F(AFrameOfSomeRows, IsNotTornWhenMoreRowsComeWithTheSamePicture) {
  watch();
  cv::Mat still = scene();
  ASSERT_EQ(see(still).verdict, FrameVerdict::good);
  const FrameFindings findings = check_.check(still);
  EXPECT_EQ(findings.verdict, FrameVerdict::good);
  EXPECT_TRUE(findings.duplicate);
}

TEST_F(AFrameOfSomeRows, IsLookedAtWholeAndFoundTurned) {
  for (const int how : {-1, 0, 1}) {  // by 180 degrees, upside down, left to right
    watch();
    cv::Mat picture;
    cv::flip(scene(), picture, how);
    see(picture);  // only the suspicion
    for (int i = 0; i < 10; ++i) {
      cv::flip(scene(), picture, how);
      ASSERT_EQ(see(picture).verdict, FrameVerdict::turned) << how << ", " << i;
    }
    ASSERT_EQ(see(scene()).verdict, FrameVerdict::good);
    ASSERT_EQ(see(scene()).verdict, FrameVerdict::good);
  }
}

TEST_F(AFrameOfSomeRows, TellsThatALampWasSwitched) {
  watch();
  FrameFindings findings = see(scene(0.5));
  EXPECT_EQ(findings.verdict, FrameVerdict::good);
  EXPECT_GT(findings.desk_change, 0.9);
  EXPECT_TRUE(findings.settling);
}

}  // namespace
}  // namespace telehug
