// SPDX-License-Identifier: Apache-2.0
#include "finger/background_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "doubles/drawn_finger.hpp"
#include "doubles/temporary_folder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

constexpr ImageSize image{640, 360};
constexpr BorderLine border{260, 0.01};

BorderStrip::Layout layout_of(const BorderLine& line, ImageSize size = image) {
  return {BorderCurve(line, size), size};
}

class BackgroundFileTest : public testing::Test {
 protected:
  std::string fault_of(const BorderStrip::Layout& layout) {
    const auto strip = read_background(path, layout);
    return strip ? "" : strip.error().message;
  }

  TemporaryFolder folder;
  std::filesystem::path path = background_file(folder / "rig.toml");
  cv::Mat empty = DrawnScene(border, image).noise(1, 3).picture();
};

TEST_F(BackgroundFileTest, LiesBesideTheCalibration) {
  EXPECT_EQ(path, folder / "rig.background.png");
}

TEST_F(BackgroundFileTest, KeepsTheStrip) {
  const BorderStrip::Layout layout = layout_of(border);
  ASSERT_TRUE(write_background(path, empty, layout).ok());
  const auto kept = read_background(path, layout);
  ASSERT_TRUE(kept.ok()) << kept.error().message;
  BorderStrip strip(layout);
  strip.sample(empty, layout);
  for (int rail = 0; rail < BorderStrip::rails; ++rail) {
    for (int channel = 0; channel < BorderStrip::channels; ++channel) {
      for (int i = 0; i < strip.columns(); ++i)
        ASSERT_NEAR(kept->row(channel, rail)[i], strip.row(channel, rail)[i], 0.5);
    }
  }
}

// Somebody's face in the webcam's picture, or what the screen shows, is nobody's business.
TEST_F(BackgroundFileTest, HoldsNothingOfTheScreenOrOfWhoSitsBeforeIt) {
  const BorderStrip::Layout layout = layout_of(border);
  ASSERT_TRUE(write_background(path, empty, layout).ok());
  const cv::Mat before = read_picture(path).value();
  for (int u = 0; u < image.width_px; ++u) {
    empty.col(u).rowRange(static_cast<int>(border.v_at(u)) + 1, image.height_px) = cv::Scalar(0, 0, 255);
    empty.col(u).rowRange(0, static_cast<int>(border.v_at(u)) - 40) = cv::Scalar(0, 0, 255);
  }
  ASSERT_TRUE(write_background(path, empty, layout).ok());
  EXPECT_TRUE(std::equal(before.datastart, before.dataend, read_picture(path)->datastart));
}

TEST_F(BackgroundFileTest, IsRefusedWithAnotherCalibration) {
  ASSERT_TRUE(write_background(path, empty, layout_of(border)).ok());
  EXPECT_EQ(fault_of(layout_of({260.4, 0.01})), "") << "the border may be found a little elsewhere";
  EXPECT_THAT(fault_of(layout_of({270, 0.01})), HasSubstr("another calibration"));
  EXPECT_THAT(fault_of(layout_of({260, 0.03})), HasSubstr("another calibration"));
  EXPECT_THAT(fault_of(layout_of(border, {1280, 720})), HasSubstr("another calibration"));
}

TEST_F(BackgroundFileTest, IsRefusedIfItIsNone) {
  const BorderStrip::Layout layout = layout_of(border);
  EXPECT_THAT(fault_of(layout), HasSubstr("can't read"));
  ASSERT_TRUE(write_png(path, empty).ok());
  EXPECT_THAT(fault_of(layout), HasSubstr("holds no background"));
  ASSERT_TRUE(write_png(path, empty, PngNote{"telehug background", "7 of a later time"}).ok());
  EXPECT_THAT(fault_of(layout), HasSubstr("another version"));
  ASSERT_TRUE(write_background(path, empty, layout).ok());
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_NE(fault_of(layout), "");
}

TEST_F(BackgroundFileTest, IsNotWrittenFromAPictureOfAnotherSize) {
  EXPECT_FALSE(write_background(path, cv::Mat(480, 640, CV_8UC3), layout_of(border)).ok());
}

}  // namespace
}  // namespace telehug
