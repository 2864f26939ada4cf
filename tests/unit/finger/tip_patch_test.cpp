// SPDX-License-Identifier: Apache-2.0
#include "finger/tip_patch.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

namespace telehug {
namespace {

constexpr int columns = 12;
constexpr int rows = 9;

// Blue grows with u, green with v, red is everywhere the same.
cv::Mat ramps() {
  cv::Mat bgr(60, 80, CV_8UC3);
  for (int v = 0; v < bgr.rows; ++v) {
    for (int u = 0; u < bgr.cols; ++u)
      bgr.at<cv::Vec3b>(v, u) = {static_cast<std::uint8_t>(3 * u), static_cast<std::uint8_t>(4 * v), 51};
  }
  return bgr;
}

std::vector<float> patch_of(const cv::Mat& bgr, const PatchPlace& place) {
  std::vector<float> values(std::size_t{rows} * columns * 3);
  sample_patch(bgr, place, values.data());
  return values;
}

TEST(TipPatch, IsInterpolatedAtItsPlace) {
  for (const auto& [step, mirrored] : {std::pair{0.4, false}, {1.0, false}, {1.7, false}, {0.4, true}, {1.7, true}}) {
    const PatchPlace place{{40.3, 30.7}, step, step / 1.5, columns, rows, mirrored};
    const auto values = patch_of(ramps(), place);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const ImagePoint at = place.picture_point(column, row);
        const float* const pixel = &values[3 * static_cast<std::size_t>(row * columns + column)];
        EXPECT_NEAR((pixel[0] + 1) * 127.5, 3 * at.u_px, 1e-3);
        EXPECT_NEAR((pixel[1] + 1) * 127.5, 4 * at.v_px, 1e-3);
        EXPECT_NEAR((pixel[2] + 1) * 127.5, 51, 1e-3);
      }
    }
  }
}

TEST(TipPatch, IsLaidAboutItsMiddle) {
  const PatchPlace place{{40, 30}, 2, 1.25, columns, rows};
  EXPECT_NEAR(place.picture_point(5.5, 4).u_px, 40, 1e-9);
  EXPECT_NEAR(place.picture_point(5.5, 4).v_px, 30, 1e-9);
  EXPECT_NEAR(place.picture_point(6.5, 4).u_px, 42, 1e-9);
  EXPECT_NEAR(place.picture_point(5.5, 6).v_px, 32.5, 1e-9);
}

TEST(TipPatch, RunsFromThePicturesRightToItsLeftIfMirrored) {
  const PatchPlace plain{{40.3, 30}, 2, 2, columns, rows};
  PatchPlace mirrored = plain;
  mirrored.mirrored = true;
  for (const double column : {0.0, 3.2, 11.0}) {
    EXPECT_NEAR(mirrored.picture_point(column, 2).u_px, plain.picture_point(columns - 1 - column, 2).u_px, 1e-9);
    EXPECT_NEAR(mirrored.picture_point(column, 2).v_px, plain.picture_point(column, 2).v_px, 1e-9);
  }
}

TEST(TipPatch, MayBeWiderThanTheLinesThatAreMixedAtOnce) {
  cv::Mat bgr(40, 1000, CV_8UC3);
  cv::randu(bgr, 0, 256);
  for (const bool mirrored : {false, true}) {
    const PatchPlace place{{500, 20}, 80, 80, columns, 1, mirrored};
    const auto values = patch_of(bgr, place);
    for (int column = 0; column < columns; ++column) {
      const auto u = static_cast<int>(place.picture_point(column, 0).u_px);
      EXPECT_NEAR((values[static_cast<std::size_t>(3 * column)] + 1) * 127.5, bgr.at<cv::Vec3b>(20, u)[0], 1e-3) << u;
    }
  }
}

TEST(TipPatch, GoesOnBeyondThePictureAsItEnds) {
  const cv::Mat bgr = ramps();
  for (const ImagePoint middle : {ImagePoint{-500, -500}, {5000, 5000}, {-3, 61}, {80, -2}}) {
    for (const bool mirrored : {false, true}) {
      const PatchPlace place{middle, 1, 1, columns, rows, mirrored};
      const auto values = patch_of(bgr, place);
      const ImagePoint at = place.picture_point(0, 0);
      EXPECT_NEAR((values[0] + 1) * 127.5, 3 * std::clamp(at.u_px, 0.0, 79.0), 1e-3);
      EXPECT_NEAR((values[1] + 1) * 127.5, 4 * std::clamp(at.v_px, 0.0, 59.0), 1e-3);
    }
  }
}

}  // namespace
}  // namespace telehug
