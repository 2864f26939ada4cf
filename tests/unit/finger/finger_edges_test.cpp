// SPDX-License-Identifier: Apache-2.0
#include "finger/finger_edges.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace telehug {
namespace {

std::vector<float> profile(int first, int end, float bezel = 40, float finger = 200) {
  std::vector<float> red(1280, bezel);
  for (int u = first; u < end; ++u)
    red[static_cast<std::size_t>(u)] = finger;
  return red;
}

TEST(FingerEdges, AreFoundToTheColumnWhereverTheGroupsFall) {
  FingerEdgeFinder finder(1280, 12);
  for (int first = 300; first < 320; ++first) {
    for (const int width : {24, 41, 77, 300}) {
      const auto columns = finder.find(profile(first, first + width));
      ASSERT_TRUE(columns.has_value()) << first << ", " << width;
      EXPECT_EQ(columns->first, first);
      EXPECT_EQ(columns->end, first + width);
    }
  }
}

TEST(FingerEdges, AreFoundForAFingerDarkerThanTheBezel) {
  FingerEdgeFinder finder(1280, 12);
  const auto columns = finder.find(profile(500, 560, 210, 120));
  ASSERT_TRUE(columns.has_value());
  EXPECT_EQ(columns->first, 500);
  EXPECT_EQ(columns->end, 560);
}

TEST(FingerEdges, AreAtLeastTwentyColumnsApart) {
  FingerEdgeFinder finder(1280, 12);
  for (int width = 4; width < 20; ++width) {
    const auto columns = finder.find(profile(500, 500 + width));
    if (columns) {
      EXPECT_GE(columns->width(), 20) << width;
    }
  }
}

TEST(FingerEdges, AreMissingWithoutASecondStep) {
  FingerEdgeFinder finder(1280, 12);
  EXPECT_FALSE(finder.find(profile(0, 0)).has_value());
  EXPECT_FALSE(finder.find(profile(700, 1280)).has_value());
  EXPECT_FALSE(finder.find(profile(500, 560, 40, 50)).has_value());
}

TEST(FingerEdges, AreMissingInAPictureOfNoWidth) {
  FingerEdgeFinder finder(15, 12);
  EXPECT_FALSE(finder.find(std::vector<float>(15, 0)).has_value());
  EXPECT_FALSE(finder.find({}).has_value());
}

}  // namespace
}  // namespace telehug
