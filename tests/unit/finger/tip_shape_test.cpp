// SPDX-License-Identifier: Apache-2.0
#include "finger/tip_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "doubles/allocation_counter.hpp"

namespace telehug {
namespace {

struct DrawnEllipse {
  double u_px = 400;
  double v_px = 300;
  double half_width_px = 24;
  double half_length_px = 26;
  double angle = 0;  // > 0: the tip is turned to the right
};

ImagePoint point_of(const DrawnEllipse& ellipse, double t) {
  const double x = ellipse.half_width_px * std::sin(t);
  const double y = ellipse.half_length_px * std::cos(t);
  const double s = std::sin(ellipse.angle);
  const double c = std::cos(ellipse.angle);
  return {ellipse.u_px + x * c + y * s, ellipse.v_px - x * s + y * c};
}

TipContour contour_of(const DrawnEllipse& ellipse) {
  TipContour contour{};
  for (std::size_t i = 0; i < TipContour::angles; ++i) {
    contour.points[i] = point_of(ellipse, (-100 + 4 * static_cast<double>(i)) * std::numbers::pi / 180);
    contour.edge[i] = 0.7F;
  }
  return contour;
}

// By search, so that it does not share the formula.
ImagePoint foremost(const DrawnEllipse& ellipse, double slope) {
  ImagePoint best = point_of(ellipse, 0);
  for (double t = -1.5; t < 1.5; t += 1e-4) {
    const ImagePoint point = point_of(ellipse, t);
    if (point.v_px - slope * point.u_px > best.v_px - slope * best.u_px) best = point;
  }
  return best;
}

TEST(TipShape, IsExactOnEllipses) {
  for (const double length : {20.0, 26.0, 34.0}) {
    for (const double angle : {-0.3, 0.0, 0.2}) {
      const DrawnEllipse ellipse{.half_length_px = length, .angle = angle};
      const TipShape shape = fit_tip_shape(contour_of(ellipse), 24, 0);
      const ImagePoint tip = foremost(ellipse, 0);
      EXPECT_NEAR(shape.tip.u_px, tip.u_px, 0.5) << length << ", " << angle;
      EXPECT_NEAR(shape.tip.v_px, tip.v_px, 0.1) << length << ", " << angle;
      EXPECT_NEAR(shape.half_width_px, 24, 0.5) << length << ", " << angle;
      EXPECT_NEAR(shape.half_length_px, length, 1) << length << ", " << angle;
      EXPECT_EQ(shape.inlier_share, 1);
    }
  }
}

TEST(TipShape, LetsGoOfAFifthOfBadPoints) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 30; ++trial) {
    const DrawnEllipse ellipse;
    TipContour contour = contour_of(ellipse);
    for (std::size_t bad = 0; bad < TipContour::angles / 5; ++bad) {
      const std::size_t i = random() % TipContour::angles;
      const double out = 1 + (random() % 2 == 0 ? -0.25 : 0.3);
      contour.points[i] = {ellipse.u_px + out * (contour.points[i].u_px - ellipse.u_px),
                           ellipse.v_px + out * (contour.points[i].v_px - ellipse.v_px)};
    }
    const TipShape shape = fit_tip_shape(contour, 24, 0);
    EXPECT_NEAR(shape.tip.v_px, ellipse.v_px + ellipse.half_length_px, 0.4) << trial;
    EXPECT_NEAR(shape.tip.u_px, ellipse.u_px, 2) << trial;
    EXPECT_LT(shape.inlier_share, 1);
    EXPECT_GT(shape.inlier_share, 0.6);
  }
}

TEST(TipShape, BridgesACornerThatTheContourCuts) {
  const DrawnEllipse ellipse;
  TipContour contour = contour_of(ellipse);
  for (std::size_t i = 30; i < 37; ++i)
    contour.points[i].v_px -= 6;
  EXPECT_NEAR(fit_tip_shape(contour, 24, 0).tip.v_px, ellipse.v_px + ellipse.half_length_px, 0.4);
}

TEST(TipShape, TheForemostPointIsAcrossTheBordersSlope) {
  for (const double slope : {-0.3, -0.1, 0.1, 0.3}) {
    const DrawnEllipse ellipse{.angle = 0.1};
    const TipShape shape = fit_tip_shape(contour_of(ellipse), 24, slope);
    const ImagePoint tip = foremost(ellipse, slope);
    EXPECT_NEAR(shape.tip.u_px, tip.u_px, 0.5) << slope;
    EXPECT_NEAR(shape.tip.v_px, tip.v_px, 0.2) << slope;
  }
}

TEST(TipShape, NoiseOfAPixelMovesTheTipByLess) {
  std::mt19937 random(9);
  std::normal_distribution<double> noise(0, 0.7);
  double sum2 = 0;
  constexpr int trials = 50;
  for (int trial = 0; trial < trials; ++trial) {
    TipContour contour = contour_of({});
    for (ImagePoint& point : contour.points)
      point = {point.u_px + noise(random), point.v_px + noise(random)};
    const double error = fit_tip_shape(contour, 24, 0).tip.v_px - 326;
    sum2 += error * error;
  }
  EXPECT_LT(std::sqrt(sum2 / trials), 0.4);
}

TEST(TipShape, AllocatesNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted";
  const TipContour contour = contour_of({});
  const auto before = allocation_count();
  EXPECT_GT(fit_tip_shape(contour, 24, 0).half_width_px, 0);
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace telehug
