// SPDX-License-Identifier: Apache-2.0
#include "eval/error_statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ErrorStatistics, KnowMeanAndTheSpreadOfASample) {
  EXPECT_DOUBLE_EQ(mean({1, 2, 6}), 3);
  EXPECT_DOUBLE_EQ(standard_deviation({1, 2, 6}), std::sqrt(7));
  EXPECT_DOUBLE_EQ(standard_deviation({5}), 0);
}

TEST(ErrorStatistics, TakeAQuantileFromTheValuesThemselves) {
  std::vector<double> hundred;
  for (int i = 100; i > 0; --i)
    hundred.push_back(i);
  EXPECT_DOUBLE_EQ(p95(hundred), 95);
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2}, 0), 1);
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2}, 1), 3);
}

TEST(BoxPlots, HaveInterpolatedQuartilesAndWhiskersThatEndAtValues) {
  const BoxPlot box = box_plot({8, 1, 2, 3, 4, 5, 6, 7});
  EXPECT_DOUBLE_EQ(box.first_quartile, 2.75);
  EXPECT_DOUBLE_EQ(box.median, 4.5);
  EXPECT_DOUBLE_EQ(box.third_quartile, 6.25);
  EXPECT_DOUBLE_EQ(box.low_whisker, 1);
  EXPECT_DOUBLE_EQ(box.high_whisker, 8);
  EXPECT_THAT(box.outliers, IsEmpty());
}

TEST(BoxPlots, SetApartWhatLiesOneAndAHalfBoxesBeyondTheBox) {
  const BoxPlot box = box_plot({0, 1, 2, 3, 4, 40, -30});
  EXPECT_THAT(box.outliers, ElementsAre(-30, 40));
  EXPECT_DOUBLE_EQ(box.low_whisker, 0);
  EXPECT_DOUBLE_EQ(box.high_whisker, 4);
}

TEST(BoxPlots, OfASingleValueAreThatValue) {
  const BoxPlot box = box_plot({7});
  for (const double value : {box.low_whisker, box.first_quartile, box.median, box.third_quartile, box.high_whisker})
    EXPECT_DOUBLE_EQ(value, 7);
}

}  // namespace
}  // namespace telehug
