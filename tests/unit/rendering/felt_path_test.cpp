// SPDX-License-Identifier: Apache-2.0
#include "rendering/felt_path.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "rendering/geometry.hpp"

namespace telehug {
namespace {

constexpr Timestamp start = from_ns(1'000'000'000);
constexpr Pace pace{5, 0.4};

class FeltPathTest : public ::testing::Test {
 protected:
  // Returns how far the place moved.
  double advance(Duration time) {
    now += time;
    double sum = 0;
    path.advance(pace, now, [&](BodyPoint from, BodyPoint to) {
      EXPECT_EQ(distance_fh(from, walked.back()), 0) << "without a gap";
      sum += distance_fh(from, to);
      walked.push_back(to);
    });
    EXPECT_EQ(distance_fh(path.place(), walked.back()), 0);
    return sum;
  }
  void lead(BodyPoint place) { path.lead(place, now); }

  Timestamp now = start;
  FeltPath path{{0, 1}, start};
  std::vector<BodyPoint> walked{{0, 1}};
};

TEST_F(FeltPathTest, follows_a_finger_of_usual_speed_at_once) {
  for (int i = 1; i < 60; ++i) {
    advance(33ms);
    lead({i * 0.1, 1});
    advance(0ms);
    EXPECT_DOUBLE_EQ(path.place().x_fh, i * 0.1);
  }
}

TEST_F(FeltPathTest, follows_a_faster_finger_along_its_whole_way_at_its_pace) {
  advance(100ms);
  lead({0.7, 1});
  EXPECT_NEAR(advance(0ms), pace.at_once_fh, 1e-12);
  EXPECT_NEAR(advance(20ms), 0.1, 1e-12);
  EXPECT_FALSE(path.arrived());
  advance(60ms);
  EXPECT_TRUE(path.arrived());
  EXPECT_DOUBLE_EQ(path.place().x_fh, 0.7);
}

TEST_F(FeltPathTest, goes_round_the_corners_that_the_finger_went) {
  advance(10ms);
  lead({0.6, 1});
  lead({0.6, 2});
  for (int i = 0; i < 40; ++i)
    advance(10ms);
  for (const BodyPoint& place : walked)
    EXPECT_TRUE(place.y_fh == 1 || place.x_fh == 0.6) << place.x_fh << ", " << place.y_fh;
  EXPECT_TRUE(path.arrived());
}

TEST_F(FeltPathTest, is_never_much_farther_behind_than_the_longest_lag) {
  constexpr double speed_fh_s = 30;  // six times the pace
  for (Duration passed = 10ms; passed <= 2s; passed += 10ms) {
    advance(10ms);
    const double x_fh = speed_fh_s * std::chrono::duration<double>(passed).count();
    lead({x_fh, 1});
    advance(0ms);
    EXPECT_LE(x_fh - path.place().x_fh, speed_fh_s * 0.21);
  }
}

TEST_F(FeltPathTest, arrives_in_time_when_the_finger_is_gone) {
  lead({20, 1});
  path.end(now);
  Duration taken{};
  for (; !path.arrived() && taken < 1s; taken += 10ms)
    advance(10ms);
  EXPECT_LE(taken, longest_lag + 10ms);
  EXPECT_GE(taken, longest_lag - 20ms) << "no faster than it must";
}

TEST_F(FeltPathTest, stays_where_it_is_when_a_place_is_none) {
  lead({std::numeric_limits<double>::quiet_NaN(), 1});
  lead({0, -std::numeric_limits<double>::infinity()});
  EXPECT_TRUE(path.arrived());
  lead({1e300, 1});
  for (int i = 0; i < 100; ++i)
    advance(10ms);
  EXPECT_TRUE(finite(path.place()));
  EXPECT_LE(path.place().x_fh, 100);
}

TEST_F(FeltPathTest, begins_where_the_first_place_is_if_it_had_none) {
  FeltPath nowhere({std::numeric_limits<double>::quiet_NaN(), 0}, start);
  EXPECT_FALSE(finite(nowhere.place()));
  nowhere.lead({0.3, 0.4}, start);
  EXPECT_EQ(nowhere.place().x_fh, 0.3);
  EXPECT_TRUE(nowhere.arrived());
}

TEST_F(FeltPathTest, holds_the_newest_place_of_more_than_it_can_remember) {
  for (int i = 1; i <= 1000; ++i)
    lead({i % 2 * 0.5, 1 + i * 0.001});
  for (int i = 0; i < 200; ++i)
    advance(10ms);
  EXPECT_TRUE(path.arrived());
  EXPECT_DOUBLE_EQ(path.place().y_fh, 2);
}

TEST_F(FeltPathTest, knows_the_fingers_speed_in_spite_of_a_place_that_is_unsure) {
  for (int i = 1; i <= 30; ++i) {
    advance(10ms);
    lead({i % 2 * 0.03, 1});
    EXPECT_LT(path.speed_fh_s(), 1);
  }
  for (int i = 1; i <= 30; ++i) {
    advance(10ms);
    lead({i * 0.04, 1});
  }
  EXPECT_NEAR(path.speed_fh_s(), 4, 0.8);
}

}  // namespace
}  // namespace telehug
