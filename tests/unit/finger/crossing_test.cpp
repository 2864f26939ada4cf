// SPDX-License-Identifier: Apache-2.0
#include "finger/crossing.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/core/mat.hpp>

#include "doubles/allocation_counter.hpp"
#include "doubles/drawn_band.hpp"
#include "finger/background_strip.hpp"

namespace telehug {
namespace {

constexpr ImageSize size{1280, 720};
constexpr double border_v = 380;
constexpr double noise = 2.5;

BorderStrip strip_of(const cv::Mat& picture, const BorderStrip::Layout& layout) {
  BorderStrip strip(layout);
  strip.sample(picture, layout);
  return strip;
}

class CrossingTest : public testing::Test {
 protected:
  const Crossings& find(const cv::Mat& picture) {
    const auto& foreground = background_.distance(strip_of(picture, layout_));
    return finder_.find(foreground, background_.new_edges(), picture, border_);
  }
  static cv::Mat desk() {
    static const cv::Mat drawn = drawn_desk(size.width_px, size.height_px, 2, noise);
    return drawn.clone();
  }

  BorderCurve border_{BorderLine{border_v, 0}, size};
  BorderStrip::Layout layout_{border_, size};
  BackgroundStrip background_{layout_, strip_of(drawn_desk(size.width_px, size.height_px), layout_)};
  CrossingFinder finder_{layout_};
};

TEST_F(CrossingTest, FindsAFingerWhereverItCrossesAndHoweverItLeans) {
  for (double slope = -1.2; slope < 1.25; slope += 0.3) {
    for (double u_px = 120; u_px < 1200; u_px += 173) {
      cv::Mat picture = desk();
      const DrawnBand band{.u_px = u_px, .v_px = border_v, .slope = slope, .half_width_px = 28};
      draw_band(picture, band);
      const Crossings& found = find(picture);
      ASSERT_EQ(found.size(), 1U) << "slope " << slope << " at " << u_px;
      EXPECT_NEAR(found[0].left.u_at(border_v), u_px - 28, 2) << "slope " << slope << " at " << u_px;
      EXPECT_NEAR(found[0].right.u_at(border_v), u_px + 28, 2) << "slope " << slope << " at " << u_px;
      EXPECT_NEAR(found[0].left.slope, slope, 0.06) << u_px;
      EXPECT_NEAR(found[0].right.slope, slope, 0.06) << u_px;
    }
  }
}

TEST_F(CrossingTest, FindsNarrowFingersAndThumbs) {
  for (const double half_width : {9.0, 14.0, 40.0, 85.0}) {
    cv::Mat picture = desk();
    draw_band(picture, {.u_px = 500, .v_px = border_v, .half_width_px = half_width});
    const Crossings& found = find(picture);
    ASSERT_EQ(found.size(), 1U) << half_width;
    EXPECT_NEAR(found[0].right.u_at(border_v) - found[0].left.u_at(border_v), 2 * half_width, 3) << half_width;
  }
}

TEST_F(CrossingTest, FindsFingersThatThePicturesSidesCut) {
  for (const double u_px : {5.0, 1275.0}) {
    cv::Mat picture = desk();
    draw_band(picture, {.u_px = u_px, .v_px = border_v, .half_width_px = 35});
    const Crossings& found = find(picture);
    ASSERT_EQ(found.size(), 1U) << u_px;
    const FingerEdge& inner = u_px < 640 ? found[0].right : found[0].left;
    EXPECT_NEAR(inner.u_at(border_v), u_px < 640 ? 40 : 1240, 3);
  }
}

TEST_F(CrossingTest, FindsTwoFingersSideBySide) {
  for (const double gap : {8.0, 16.0, 60.0, 400.0}) {
    cv::Mat picture = desk();
    draw_band(picture, {.u_px = 500, .v_px = border_v, .half_width_px = 28});
    draw_band(picture, {.u_px = 556 + gap, .v_px = border_v, .half_width_px = 28});
    EXPECT_EQ(find(picture).size(), 2U) << "gap " << gap;
  }
}

TEST_F(CrossingTest, TheColumnsOfAFingerCoverItAtAllRails) {
  cv::Mat picture = desk();
  draw_band(picture, {.u_px = 640, .v_px = border_v, .slope = 0.6, .half_width_px = 28});
  const Crossings& found = find(picture);
  ASSERT_EQ(found.size(), 1U);
  const double deepest_px = layout_.offset_px(BorderStrip::rails - 1);
  EXPECT_NEAR(layout_.column_centre_px(found[0].first_column), 640 + 0.6 * deepest_px - 28, 8);
  EXPECT_NEAR(layout_.column_centre_px(found[0].last_column), 640 + 28, 8);
}

TEST_F(CrossingTest, SoftShadowsAreNoFingers) {
  for (const double opacity : {0.1, 0.2}) {
    for (const double slope : {-0.5, 0.0, 0.5}) {
      cv::Mat picture = desk();
      draw_band(picture, {.u_px = 600,
                          .v_px = border_v,
                          .slope = slope,
                          .half_width_px = 40,
                          .colour = {0, 0, 0},
                          .opacity = opacity,
                          .softness_px = 30});
      EXPECT_TRUE(find(picture).empty()) << opacity << ", " << slope;
    }
  }
}

TEST_F(CrossingTest, NoiseAloneIsNoFinger) {
  for (unsigned seed = 10; seed < 22; ++seed)
    EXPECT_TRUE(find(drawn_desk(size.width_px, size.height_px, seed, noise)).empty()) << seed;
}

TEST_F(CrossingTest, TheClearestFingerComesFirst) {
  cv::Mat picture = desk();
  draw_band(picture, {.u_px = 300, .v_px = border_v, .colour = {95, 110, 150}});
  draw_band(picture, {.u_px = 900, .v_px = border_v, .colour = {160, 190, 235}});
  const Crossings& found = find(picture);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_GE(found[0].strength, found[1].strength);
  EXPECT_NEAR(found[0].left.u_at(border_v), 875, 3);
}

TEST_F(CrossingTest, AllocatesNothingPerFrame) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted";
  cv::Mat picture = desk();
  draw_band(picture, {.u_px = 500, .v_px = border_v});
  const auto& foreground = background_.distance(strip_of(picture, layout_));
  const auto& new_edges = background_.new_edges();
  const auto before = allocation_count();
  const Crossings& found = finder_.find(foreground, new_edges, picture, border_);
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(found.size(), 1U);
}

}  // namespace
}  // namespace telehug
