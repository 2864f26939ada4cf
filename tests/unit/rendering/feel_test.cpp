// SPDX-License-Identifier: Apache-2.0
#include "rendering/feel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace telehug {
namespace {

constexpr Timestamp start = from_ns(1'000'000'000);

TEST(Feel, begins_a_hold_firmly_and_lets_it_fade_within_two_seconds) {
  EXPECT_EQ(hold_level(0ms), 1);
  EXPECT_EQ(hold_level(150ms), 1);
  for (Duration age = 160ms; age <= 2s; age += 10ms)
    EXPECT_LT(hold_level(age), hold_level(age - 10ms)) << to_ms(age);
  EXPECT_LT(hold_level(2s), 0.4);
}

TEST(Feel, ends_a_long_hold_in_gentle_pulses_that_leave_a_motor_off_for_more_than_half_of_the_time) {
  int on = 0;
  int rounds = 0;
  double strongest = 0;
  for (Duration age = 2s; age < 62s; age += 10ms, ++rounds) {
    on += hold_level(age) > 0 ? 1 : 0;
    strongest = std::max(strongest, hold_level(age));
  }
  EXPECT_LT(on, rounds / 2);
  EXPECT_GT(on, rounds / 4) << "the hand is still there";
  EXPECT_LE(strongest, 0.4);
  EXPECT_GT(strongest, 0.3);
}

TEST(Feel, changes_no_level_by_a_jerk) {
  for (Duration age{}; age < 20s; age += 10ms) {
    EXPECT_NEAR(hold_level(age + 10ms), hold_level(age), 0.03) << to_ms(age);
    EXPECT_NEAR(hug_level(age + 10ms), hug_level(age), 0.03) << to_ms(age);
  }
  for (double speed = 0; speed < 1000; ++speed)
    EXPECT_NEAR(stroke_level(speed + 1), stroke_level(speed), 0.01) << speed;
}

TEST(Feel, holds_a_hug_for_longer_than_a_hand) {
  EXPECT_EQ(hug_level(0ms), hug_level(2s));
  EXPECT_GT(hug_level(2s), 2 * hold_level(2s));
  EXPECT_LT(hug_level(4s), 0.45);
}

TEST(Feel, keeps_strokes_gentle_and_fast_ones_a_little_firmer) {
  EXPECT_EQ(stroke_level(10), stroke_level(100)) << "as fast as caresses are";
  EXPECT_GT(stroke_level(200), stroke_level(100));
  EXPECT_LE(stroke_level(1e9), 0.6);
  EXPECT_EQ(stroke_level(std::numeric_limits<double>::infinity()), stroke_level(1e9));
  EXPECT_EQ(stroke_level(std::nan("")), stroke_level(0));
  EXPECT_EQ(stroke_level(-5), stroke_level(0));
}

TEST(Feel, gives_warmth_only_after_seconds_and_then_slowly) {
  EXPECT_EQ(warmth(0s), 0);
  EXPECT_EQ(warmth(3s), 0);
  for (Duration rested = 4s; rested <= 13s; rested += 1s)
    EXPECT_NEAR(warmth(rested) - warmth(rested - 1s), 0.1, 1e-9);
  EXPECT_EQ(warmth(1h), 1);
}

TEST(Feel, puts_bursts_as_far_apart_as_apparent_motion_asks_for) {
  EXPECT_NEAR(to_ms(burst_distance), 0.32 * to_ms(burst) + 47.3, 1e-3);
}

TEST(SteadyLevel, follows_a_jump_in_small_steps_and_arrives) {
  SteadyLevel level(1, start);
  EXPECT_EQ(level.follow(1, start + 1s), 1);
  double before = 1;
  for (Duration passed = 10ms; passed <= 200ms; passed += 10ms) {
    const double now = level.follow(0.35, start + 1s + passed);
    EXPECT_LE(now, before);
    EXPECT_GE(now, before - 0.051);
    before = now;
  }
  EXPECT_EQ(before, 0.35);
  EXPECT_EQ(level.follow(0.9, start + 5s), 0.9);
}

}  // namespace
}  // namespace telehug
