// SPDX-License-Identifier: Apache-2.0
#include "finger/border_strip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "calibration/rig_camera.hpp"
#include "doubles/allocation_counter.hpp"

namespace telehug {
namespace {

cv::Mat random_picture(ImageSize size) {
  cv::Mat picture(size.height_px, size.width_px, CV_8UC3);
  std::mt19937 random(7);
  for (int v = 0; v < picture.rows; ++v)
    std::generate_n(picture.ptr<std::uint8_t>(v), 3 * picture.cols,
                    [&] { return static_cast<std::uint8_t>(random()); });
  return picture;
}

// Mean of the pixels that a cell stands for.
double mean_of(const cv::Mat& picture, const BorderStrip::Layout& layout, int rail, int column, int channel) {
  const int row = layout.first_row[static_cast<std::size_t>(rail * layout.columns + column)];
  double sum = 0;
  for (int v = row; v < row + 2; ++v) {
    for (int i = 0; i < layout.column_px; ++i)
      sum += picture.at<cv::Vec3b>(v, column * layout.column_px + i)[channel];
  }
  return sum / (2 * layout.column_px);
}

class BorderStripOfSize : public testing::TestWithParam<ImageSize> {
 protected:
  ImageSize size_ = GetParam();
};

TEST_P(BorderStripOfSize, CellsAverageTwoRowsOfTheirColumns) {
  const cv::Mat picture = random_picture(size_);
  const BorderStrip::Layout layout(BorderCurve(BorderLine{0.6 * size_.height_px, 0.05}, size_), size_);
  BorderStrip strip(layout);
  strip.sample(picture, layout);
  for (int rail = 0; rail < BorderStrip::rails; ++rail) {
    for (int column = 0; column < layout.columns; ++column) {
      for (int channel = 0; channel < BorderStrip::channels; ++channel) {
        ASSERT_NEAR(strip.row(channel, rail)[column], mean_of(picture, layout, rail, column, channel), 1e-3)
            << rail << ", " << column;
      }
    }
  }
}

TEST_P(BorderStripOfSize, CellsCoverTheWholeWidthAndTheSamePartOfTheHeight) {
  const BorderStrip::Layout layout(BorderCurve(BorderLine{0.6 * size_.height_px, 0}, size_), size_);
  EXPECT_LE(layout.columns * layout.column_px, size_.width_px);
  EXPECT_GT((layout.columns + 1) * layout.column_px, size_.width_px);
  EXPECT_NEAR(layout.offset_px(BorderStrip::rails - 1) / size_.height_px, -0.09, 0.01);
}

TEST_P(BorderStripOfSize, RailsKeepTheirDistanceFromASlopedBorder) {
  const BorderCurve border(BorderLine{0.5 * size_.height_px, -0.1}, size_);
  const BorderStrip::Layout layout(border, size_);
  for (int rail = 0; rail < BorderStrip::rails; ++rail) {
    for (int column = 0; column < layout.columns; ++column) {
      const double middle_v = layout.first_row[static_cast<std::size_t>(rail * layout.columns + column)] + 0.5;
      ASSERT_NEAR(middle_v - border.v_at(layout.column_centre_px(column)), layout.offset_px(rail), 0.51);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfUsualWebcams, BorderStripOfSize,
                         testing::Values(ImageSize{640, 360}, ImageSize{640, 480}, ImageSize{1280, 720},
                                         ImageSize{1920, 1080}));

TEST(BorderStrip, RailsFollowABorderThatTheLensBends) {
  constexpr ImageSize size{1280, 720};
  const RigCamera camera({.focal_px = 900, .k1 = -0.1, .position_mm = {260, -15, 60}}, size);
  const BorderCurve border(camera, {520, 290, 1920, 1080});
  ASSERT_GT(std::abs(border.v_at(0) - border.v_at(640)), 5) << "the border is nearly straight";
  const BorderStrip::Layout layout(border, size);
  for (const int column : {0, 100, 320, 639}) {
    const double middle_v = layout.first_row[static_cast<std::size_t>(5 * layout.columns + column)] + 0.5;
    EXPECT_NEAR(middle_v, border.v_at(layout.column_centre_px(column)) + layout.offset_px(5), 0.51) << column;
  }
}

TEST(BorderStrip, RailsThatLeaveThePictureRepeatItsFirstRows) {
  constexpr ImageSize size{640, 360};
  const BorderStrip::Layout layout(BorderCurve(BorderLine{6, 0}, size), size);
  const cv::Mat picture = random_picture(size);
  BorderStrip strip(layout);
  strip.sample(picture, layout);
  EXPECT_EQ(layout.first_row.back(), 0);
  EXPECT_NEAR(strip.row(1, BorderStrip::rails - 1)[3],
              (picture.at<cv::Vec3b>(0, 3)[1] + picture.at<cv::Vec3b>(1, 3)[1]) / 2.0, 1e-3);
}

TEST(BorderStrip, IsKeptAsAPictureAndComesBackRounded) {
  constexpr ImageSize size{1280, 720};
  const BorderStrip::Layout layout(BorderCurve(BorderLine{400, 0.02}, size), size);
  BorderStrip strip(layout);
  strip.sample(random_picture(size), layout);
  BorderStrip back(layout);
  back.set(strip.picture());
  for (int rail = 0; rail < BorderStrip::rails; ++rail) {
    for (int channel = 0; channel < BorderStrip::channels; ++channel)
      ASSERT_NEAR(back.row(channel, rail)[17 * rail], strip.row(channel, rail)[17 * rail], 0.5);
  }
}

TEST(BorderStrip, SamplingAllocatesNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted";
  constexpr ImageSize size{1280, 720};
  const BorderStrip::Layout layout(BorderCurve(BorderLine{400, 0.02}, size), size);
  const cv::Mat picture = random_picture(size);
  BorderStrip strip(layout);
  const auto before = allocation_count();
  strip.sample(picture, layout);
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace telehug
