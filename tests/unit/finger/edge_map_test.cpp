// SPDX-License-Identifier: Apache-2.0
#include "finger/edge_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "doubles/allocation_counter.hpp"

namespace telehug {
namespace {

constexpr ImageSize size{160, 120};
const cv::Rect everything(0, 0, size.width_px, size.height_px);

// Two colours that meet in a line through (80, 60) whose normal has this angle to the picture's rows.
cv::Mat step_at(double angle, const cv::Vec3b& here, const cv::Vec3b& there) {
  cv::Mat picture(size.height_px, size.width_px, CV_8UC3);
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u)
      picture.at<cv::Vec3b>(v, u) = (u - 79.5) * std::cos(angle) + (v - 59.5) * std::sin(angle) > 0 ? there : here;
  }
  return picture;
}

TEST(EdgeMap, AStepOfHalfStepGreyLevelsHasHalfTheStrength) {
  EdgeMap edges(size);
  edges.compute(step_at(0, {100, 100, 100}, {100, 115, 100}), everything);
  EXPECT_NEAR(edges.strength(79, 60, 1, 0), 0.5, 0.001);
  EXPECT_NEAR(edges.strength(79, 60, -1, 0), 0.5, 0.001) << "from the other side";
  EXPECT_NEAR(edges.strength(79, 60, 0, 1), 0, 0.001) << "along the edge";
  EXPECT_NEAR(edges.strength(90, 60, 1, 0), 0, 0.001) << "beside it";
}

TEST(EdgeMap, StepsOfAllChannelsAddUpAsDistancesDo) {
  EdgeMap edges(size);
  edges.compute(step_at(0, {100, 100, 100}, {120, 60, 140}), everything);
  const double step = std::hypot(20, 40, 40);
  EXPECT_NEAR(edges.strength(81, 60, 1, 0), step / (step + 15), 0.001);
}

TEST(EdgeMap, TheLargestStepsStayWithinRange) {
  EdgeMap edges(size);
  edges.compute(step_at(0, {0, 0, 0}, {255, 255, 255}), everything);
  const double step = 255 * std::sqrt(3.0);
  EXPECT_NEAR(edges.strength(79, 60, 1, 0), step / (step + 15), 0.001);
}

TEST(EdgeMap, AnEdgeIsStrongestAlongItsNormal) {
  for (double angle = 0; angle < 3.1; angle += 0.2) {
    EdgeMap edges(size);
    edges.compute(step_at(angle, {40, 50, 60}, {90, 120, 150}), everything);
    double strongest = -1;
    double found = 0;
    for (double a = 0; a < std::numbers::pi; a += 0.02) {
      const auto strength = edges.strength(80, 60, static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a)));
      if (static_cast<double>(strength) > strongest) {
        strongest = static_cast<double>(strength);
        found = a;
      }
    }
    EXPECT_NEAR(std::abs(std::cos(found - angle)), 1, 0.04) << angle;
  }
}

TEST(EdgeMap, APartShowsWhatTheWholeShows) {
  const cv::Mat picture = step_at(0.7, {40, 50, 60}, {90, 120, 150});
  EdgeMap whole(size);
  whole.compute(picture, everything);
  EdgeMap part(size);
  part.compute(picture, {60, 40, 60, 50});
  for (float u = 70; u < 95; u += 1)
    EXPECT_EQ(part.strength(u, 62, 0.6F, 0.8F), whole.strength(u, 62, 0.6F, 0.8F)) << u;
}

TEST(EdgeMap, ThereIsNothingOutsideThePart) {
  const cv::Mat picture = step_at(0, {40, 50, 60}, {90, 120, 150});
  EdgeMap edges(size);
  edges.compute(picture, {60, 40, 60, 50});
  EXPECT_GT(edges.strength(80, 60, 1, 0), 0.5);
  for (const float v : {-300.0F, 20.0F, 38.9F, 91.0F, 5000.0F})
    EXPECT_EQ(edges.strength(80, v, 1, 0), 0) << v;
  for (const float u : {-300.0F, 20.0F, 122.0F, 5000.0F})
    EXPECT_EQ(edges.strength(u, 60, 1, 0), 0) << u;
}

TEST(EdgeMap, APartThatReachesBeyondThePictureIsCut) {
  EdgeMap edges(size);
  const cv::Mat picture = step_at(0, {40, 50, 60}, {90, 120, 150});
  edges.compute(picture, {-50, -50, 1000, 1000});
  EXPECT_GT(edges.strength(80, 60, 1, 0), 0.5);
  edges.compute(picture, {500, 500, 40, 40});
  EXPECT_EQ(edges.strength(520, 520, 1, 0), 0);
}

TEST(EdgeMap, AllocatesNothingPerFrame) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted";
  const cv::Mat picture = step_at(0, {40, 50, 60}, {90, 120, 150});
  EdgeMap edges(size);
  const auto before = allocation_count();
  edges.compute(picture, everything);
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace telehug
