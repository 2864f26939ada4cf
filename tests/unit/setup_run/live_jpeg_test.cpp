// SPDX-License-Identifier: Apache-2.0
#include "setup_run/live_jpeg.hpp"

#include <gtest/gtest.h>

#include "doubles/fake_clock.hpp"
#include "doubles/test_pictures.hpp"
#include "pictures/jpeg_decoder.hpp"

namespace telehug {
namespace {

class ALivePicture : public testing::Test {
 protected:
  [[nodiscard]] static cv::Mat decoded(const std::string& jpeg) {
    cv::Mat picture;
    EXPECT_TRUE(JpegDecoder{}.decode({reinterpret_cast<const std::uint8_t*>(jpeg.data()), jpeg.size()}, picture));
    return picture;
  }

  FakeClock clock;
  LiveJpeg live{clock};
  cv::Mat picture = sloping_picture(1280, 720);
};

TEST_F(ALivePicture, IsNotMadeUntilSomebodyAsks) {
  live.look(picture);
  EXPECT_EQ(live.newest(), nullptr);
  live.look(picture);
  EXPECT_NE(live.newest(), nullptr);
}

TEST_F(ALivePicture, IsASmallJpegOfTheSameShape) {
  (void)live.newest();
  live.look(picture);
  const cv::Mat seen = decoded(*live.newest());
  EXPECT_EQ(seen.size(), cv::Size(640, 360));
  const auto at = [&](int column, int row) { return seen.at<cv::Vec3b>(row, column); };
  EXPECT_NEAR(at(600, 180)[0], picture.at<cv::Vec3b>(360, 1200)[0], 6);
}

TEST_F(ALivePicture, IsAsLargeAsASmallCamerasPictures) {
  (void)live.newest();
  live.look(sloping_picture(320, 240));
  EXPECT_EQ(decoded(*live.newest()).size(), cv::Size(320, 240));
}

TEST_F(ALivePicture, IsMadeTenTimesASecondAtTheMost) {
  (void)live.newest();
  live.look(picture);
  const auto first = live.newest();
  clock.advance(99ms);
  live.look(picture);
  EXPECT_EQ(live.newest(), first);
  clock.advance(1ms);
  live.look(picture);
  EXPECT_NE(live.newest(), first);
}

TEST_F(ALivePicture, IsMadeNoMoreWhenNobodyAsksAndThenIsNoOldOne) {
  (void)live.newest();
  live.look(picture);
  clock.advance(1001ms);
  live.look(picture);
  EXPECT_EQ(live.newest(), nullptr);
}

TEST_F(ALivePicture, IsGoneWithItsCamera) {
  (void)live.newest();
  live.look(picture);
  live.forget();
  EXPECT_EQ(live.newest(), nullptr);
}

}  // namespace
}  // namespace telehug
