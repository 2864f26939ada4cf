// SPDX-License-Identifier: Apache-2.0
#include "simulator/pin_activity.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace telehug {
namespace {

constexpr std::uint64_t ms = jacket_cycles_per_ms;

class PinActivityTest : public ::testing::Test {
 protected:
  std::vector<ActivityChange> changes;
  PinActivity activity{[this](const ActivityChange& change) { changes.push_back(change); }};
};

TEST_F(PinActivityTest, SeesOneRunInAModulatedPin) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    activity.on_edge({i * ms, 4, true}, static_cast<std::int64_t>(i));
    activity.on_edge({i * ms + 100, 4, false}, static_cast<std::int64_t>(i));
    activity.advance(i * ms + 200);
  }
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_TRUE(changes[0].on);
  EXPECT_EQ(changes[0].channel, 4);
  EXPECT_EQ(changes[0].cycle, 0U);
}

TEST_F(PinActivityTest, TellsTheEndWithTheTimeOfTheLastHighLevel) {
  activity.on_edge({1000, 4, true}, 10);
  activity.on_edge({2000, 4, false}, 20);
  activity.advance(2000 + 3 * ms);
  EXPECT_EQ(changes.size(), 1U);
  activity.advance(2001 + 3 * ms);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_FALSE(changes[1].on);
  EXPECT_EQ(changes[1].cycle, 2000U);
  EXPECT_EQ(changes[1].monotonic_ns, 20);
}

TEST_F(PinActivityTest, DoesNotEndAPinThatStaysHigh) {
  activity.on_edge({1000, 4, true}, 10);
  activity.advance(1000 * ms);
  EXPECT_TRUE(activity.is_on(4));
}

TEST_F(PinActivityTest, EndsEverythingWithThePower) {
  activity.on_edge({1000, 4, true}, 10);
  activity.on_edge({1000, 5, true}, 10);
  activity.on_edge({1500, 5, false}, 15);
  activity.end_all(9000, 90);
  ASSERT_EQ(changes.size(), 4U);
  EXPECT_EQ(changes[2].cycle, 9000U);
  EXPECT_EQ(changes[3].cycle, 1500U);
}

}  // namespace
}  // namespace telehug
