// SPDX-License-Identifier: Apache-2.0
#include "finger/aligned_patch.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <random>

namespace telehug {
namespace {

cv::Mat random_picture(int columns, int rows) {
  cv::Mat picture(rows, columns, CV_8UC3);
  std::mt19937 random(7);
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < columns; ++u)
      picture.at<cv::Vec3b>(v, u) = {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()),
                                     static_cast<std::uint8_t>(random())};
  }
  return picture;
}

TEST(AlignedPatch, ShiftsEachColumnSoThatTheBorderIsLevel) {
  const cv::Mat picture = random_picture(200, 100);
  const BorderLine border{40, 0.08};
  AlignedPatch patch({60, 30});
  patch.cut(picture, border, -5, 30, 120, 60);
  for (int u = 120; u < 180; ++u) {
    for (int row = -5; row < 25; ++row) {
      const auto expected = picture.at<cv::Vec3b>(static_cast<int>(std::lround(border.v_at(u))) + row, u);
      const std::uint8_t* const pixel = patch.pixels(row, u);
      ASSERT_EQ(cv::Vec3b(pixel[0], pixel[1], pixel[2]), expected) << u << ", " << row;
    }
  }
}

TEST(AlignedPatch, RepeatsThePicturesEdgeOutsideIt) {
  const cv::Mat picture = random_picture(50, 20);
  AlignedPatch patch({56, 40});
  patch.cut(picture, {10, 0}, -20, 40, -3, 56);
  EXPECT_EQ(patch.pixels(-20, -3)[1], picture.at<cv::Vec3b>(0, 0)[1]);
  EXPECT_EQ(patch.pixels(19, 52)[2], picture.at<cv::Vec3b>(19, 49)[2]);
  EXPECT_EQ(patch.pixels(0, 52)[0], picture.at<cv::Vec3b>(10, 49)[0]);
}

TEST(AlignedPatch, FiltersAsOpenCvDoes) {
  const cv::Mat picture = random_picture(64, 48);
  cv::Mat expected;
  cv::erode(picture, expected, cv::Mat());
  cv::dilate(expected, expected, cv::Mat());
  cv::GaussianBlur(expected, expected, {3, 3}, 0);
  AlignedPatch patch({64, 48});
  patch.cut(picture, {0, 0}, 0, 48, 0, 64);
  patch.erode_dilate_smooth();
  for (int v = AlignedPatch::margin_px; v < 48 - AlignedPatch::margin_px; ++v) {
    for (int u = AlignedPatch::margin_px; u < 64 - AlignedPatch::margin_px; ++u) {
      for (int c = 0; c < 3; ++c)
        ASSERT_LE(std::abs(patch.pixels(v, u)[c] - expected.at<cv::Vec3b>(v, u)[c]), 1) << u << ", " << v;
    }
  }
}

TEST(AlignedPatch, RefusesPicturesTooSmallToFilter) {
  EXPECT_THROW(AlignedPatch({3, 3}), std::invalid_argument);
}

}  // namespace
}  // namespace telehug
