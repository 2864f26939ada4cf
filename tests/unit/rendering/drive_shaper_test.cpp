// SPDX-License-Identifier: Apache-2.0
#include "rendering/drive_shaper.hpp"

#include <gtest/gtest.h>

#include "unit/rendering/rendering_builders.hpp"

namespace telehug {
namespace {

constexpr Timestamp start = from_ns(1'000'000'000);
using News = DriveShaper::News;

class DriveShaperTest : public ::testing::Test {
 protected:
  // What it is told of that, if anything.
  std::optional<Drive> tell(double strength, Timestamp at, Duration length = 200ms) {
    shaper.want(strength, at + length, at);
    const auto drive = shaper.state(at);
    shaper.told(at);
    return drive;
  }
  News news(double strength, Timestamp at, Timestamp end) {
    shaper.want(strength, end, at);
    return shaper.news(at);
  }

  Actuator actuator = motor(7, {}, {});
  DriveShaper shaper{actuator};
};

TEST_F(DriveShaperTest, gives_the_strength_by_the_motors_gamma) {
  actuator.gamma = 2;
  EXPECT_DOUBLE_EQ(tell(0.5, start)->strength, 0.25);
  EXPECT_EQ(tell(0.5, start)->actuator, 7);
  EXPECT_EQ(tell(0.5, start)->end, start + 200ms);
  actuator.gamma = 0.5;
  EXPECT_DOUBLE_EQ(tell(0.25, start)->strength, 0.5);
  EXPECT_EQ(tell(1, start)->strength, 1);
  EXPECT_EQ(tell(9, start)->strength, 1);
}

TEST_F(DriveShaperTest, starts_a_motor_that_was_off_at_full_strength) {
  actuator.kick = 40ms;
  EXPECT_EQ(tell(0.3, start)->strength, 1);
  EXPECT_EQ(tell(0.3, start + 30ms)->strength, 1) << "renewed meanwhile";
  EXPECT_EQ(news(0.3, start + 40ms, start + 200ms), News::urgent);
  EXPECT_EQ(tell(0.3, start + 40ms)->strength, 0.3);
  EXPECT_EQ(tell(0.3, start + 80ms)->strength, 0.3);
}

TEST_F(DriveShaperTest, needs_no_start_for_full_strength) {
  actuator.kick = 40ms;
  EXPECT_EQ(tell(1, start)->end, start + 200ms);
  EXPECT_EQ(news(1, start + 40ms, start + 200ms), News::none);
}

TEST_F(DriveShaperTest, lets_a_start_end_by_itself_if_nobody_comes_in_time) {
  actuator.kick = 40ms;
  EXPECT_EQ(tell(0.3, start)->end, start + 60ms);
  EXPECT_EQ(tell(0.3, start + 300ms)->strength, 1) << "it was off for long: another start";
}

TEST_F(DriveShaperTest, never_starts_for_longer_than_is_wanted) {
  actuator.kick = 40ms;
  EXPECT_EQ(tell(0.3, start, 15ms)->end, start + 15ms);
}

TEST_F(DriveShaperTest, starts_no_motor_that_still_turns) {
  actuator.kick = 40ms;
  tell(0.3, start);
  tell(0.3, start + 50ms);
  EXPECT_EQ(tell(0, start + 100ms)->strength, 0);
  EXPECT_EQ(tell(0.3, start + 150ms)->strength, 0.3);
  tell(0, start + 200ms);
  EXPECT_EQ(tell(0.3, start + 300ms)->strength, 1) << "it has come to rest";
}

TEST_F(DriveShaperTest, does_neither_to_a_heater) {
  actuator.kind = ActuatorKind::heater;
  actuator.kick = 40ms;
  actuator.gamma = 3;
  EXPECT_EQ(tell(0.5, start)->strength, 0.5);
}

TEST_F(DriveShaperTest, says_once_that_it_is_off) {
  EXPECT_FALSE(tell(0, start));
  tell(0.5, start);
  const auto off = tell(0, start + 10ms);
  ASSERT_TRUE(off);
  EXPECT_EQ(off->strength, 0);
  EXPECT_FALSE(tell(0, start + 20ms));
}

TEST_F(DriveShaperTest, needs_not_say_that_a_drive_is_off_which_has_ended) {
  tell(0.5, start);
  EXPECT_FALSE(tell(0, start + 200ms));
}

TEST_F(DriveShaperTest, has_news_of_what_can_be_felt_only) {
  const Timestamp end = start + 200ms;
  EXPECT_EQ(news(0, start, end), News::none);
  EXPECT_EQ(news(0.5, start, end), News::urgent);
  tell(0.5, start);
  EXPECT_EQ(news(0.5, start, end), News::none);
  EXPECT_EQ(news(0.51, start, end), News::none);
  EXPECT_EQ(news(0.53, start, end), News::slight);
  EXPECT_EQ(news(0.5, start, end + 1ms), News::slight);
  EXPECT_EQ(news(0.5, start, end - 50ms), News::none) << "it will be told to stop";
  EXPECT_EQ(news(0, start, end), News::urgent);
}

TEST_F(DriveShaperTest, forgets_that_it_runs) {
  tell(0.5, start);
  shaper.forget();
  EXPECT_FALSE(shaper.state(start));
  EXPECT_EQ(news(0.5, start, start + 200ms), News::urgent);
}

}  // namespace
}  // namespace telehug
