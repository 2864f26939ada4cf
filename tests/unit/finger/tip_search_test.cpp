// SPDX-License-Identifier: Apache-2.0
#include "finger/tip_search.hpp"

#include <gtest/gtest.h>

#include <opencv2/core/mat.hpp>
#include <optional>

#include "doubles/allocation_counter.hpp"
#include "doubles/drawn_band.hpp"

namespace telehug {
namespace {

constexpr ImageSize size{1280, 720};
constexpr double border_v = 300;

cv::Mat desk() {
  static const cv::Mat drawn = drawn_desk(size.width_px, size.height_px, 3, 2.5);
  return drawn.clone();
}

class TipSearchTest : public testing::Test {
 protected:
  // The search for the tip of the one finger in `picture`, whose sides are as drawn.
  TipSearch::Guesses find(const cv::Mat& picture, const DrawnBand& band) {
    const FingerEdge left{band.u_px - band.half_width_px, band.v_px, band.slope};
    const FingerEdge right{band.u_px + band.half_width_px, band.v_px, band.slope};
    axis_.emplace(Crossing{left, right}, BorderCurve(BorderLine{border_v, 0}, size));
    edges_.compute(picture, {0, 0, size.width_px, size.height_px});
    return search_.find(edges_, *axis_, size.height_px - 4, 1);
  }

  EdgeMap edges_{size};
  TipSearch search_{size};
  std::optional<FingerAxis> axis_;
};

TEST_F(TipSearchTest, FindsATipWithinTwoPixels) {
  for (double tip_v = 320; tip_v < 690; tip_v += 23.5) {
    cv::Mat picture = desk();
    const DrawnBand band{.u_px = 640, .v_px = border_v, .tip_v_px = tip_v};
    draw_band(picture, band);
    const auto guesses = find(picture, band);
    ASSERT_FALSE(guesses.empty());
    EXPECT_NEAR(guesses[0].tip_v, tip_v, 2);
  }
}

TEST_F(TipSearchTest, FindsTipsOfLeaningFingers) {
  for (double slope = -0.8; slope < 0.85; slope += 0.2) {
    cv::Mat picture = desk();
    const DrawnBand band{.u_px = 640, .v_px = border_v, .slope = slope, .tip_v_px = 500};
    draw_band(picture, band);
    const auto guesses = find(picture, band);
    ASSERT_FALSE(guesses.empty());
    EXPECT_NEAR(guesses[0].tip_v, 500, 2) << slope;
    EXPECT_NEAR(guesses[0].root_u + guesses[0].lean * (500 - guesses[0].root_v), 640 + slope * 200, 4) << slope;
  }
}

TEST_F(TipSearchTest, FindsFlatTipsAndLongNails) {
  for (const double length : {0.7, 1.0, 1.4, 1.8, 2.3}) {
    cv::Mat picture = desk();
    const DrawnBand band{.u_px = 640, .v_px = border_v, .tip_v_px = 500, .tip_length_px = 25 * length};
    draw_band(picture, band);
    const auto guesses = find(picture, band);
    ASSERT_FALSE(guesses.empty());
    EXPECT_NEAR(guesses[0].tip_v, 500, 2) << length;
  }
}

TEST_F(TipSearchTest, FindsATouchJustPastTheBorder) {
  cv::Mat picture = desk();
  const DrawnBand band{.u_px = 640, .v_px = border_v, .tip_v_px = border_v + 4};
  draw_band(picture, band);
  EXPECT_NEAR(find(picture, band)[0].tip_v, border_v + 4, 2);
}

TEST_F(TipSearchTest, GuessesAreApartAndInOrderOfTheirStrength) {
  cv::Mat picture = desk();
  const DrawnBand band{.u_px = 640, .v_px = border_v, .tip_v_px = 500};
  draw_band(picture, band);
  DrawnBand nail = band;
  nail.tip_v_px = 490;
  nail.half_width_px = 16;
  nail.colour = {180, 190, 240};
  draw_band(picture, nail);
  const auto guesses = find(picture, band);
  for (std::size_t i = 1; i < guesses.size(); ++i) {
    EXPECT_GE(guesses[i - 1].strength, guesses[i].strength);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GE(std::abs(guesses[i].tip_v - guesses[k].tip_v), 10);
  }
}

TEST_F(TipSearchTest, ATipIsStrongerThanAStraightFingerThatGoesOn) {
  cv::Mat with_tip = desk();
  DrawnBand band{.u_px = 640, .v_px = border_v, .tip_v_px = 500};
  draw_band(with_tip, band);
  const double tip = find(with_tip, band)[0].strength;
  cv::Mat without = desk();
  band.tip_v_px = 1e9;
  draw_band(without, band);
  EXPECT_GT(tip, find(without, band)[0].strength + 0.2);
}

TEST_F(TipSearchTest, AllocatesNothingPerFrame) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted";
  cv::Mat picture = drawn_desk(size.width_px, size.height_px);
  const DrawnBand band{.u_px = 640, .v_px = border_v, .tip_v_px = 500};
  draw_band(picture, band);
  find(picture, band);
  const auto before = allocation_count();
  EXPECT_FALSE(search_.find(edges_, *axis_, size.height_px - 4, 1).empty());
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace telehug
