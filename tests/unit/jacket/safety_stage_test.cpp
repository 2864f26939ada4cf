// SPDX-License-Identifier: Apache-2.0
#include "safety/safety_stage.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "unit/jacket/safety_stage_fixture.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST_F(SafetyStageTest, drives_what_it_is_told_at_once) {
  EXPECT_EQ(drive(1), FeltOutcome::driven);
  EXPECT_EQ(intensity(0), 255);
  EXPECT_THAT(running(), ElementsAre(0));
  EXPECT_THAT(safety->running(), ElementsAre(1));
}

TEST_F(SafetyStageTest, spreads_strength_over_what_the_actuator_may_do) {
  drive(2, 1);
  EXPECT_EQ(intensity(1), 99);  // step 12 of 31: the last within 0.4
  drive(2, 0.001);
  EXPECT_EQ(intensity(1), 58);  // step 7 of 31: the first from 0.2 on
  drive(2, 0);
  EXPECT_EQ(intensity(1), 0);
}

TEST_F(SafetyStageTest, keeps_the_limit_for_all_below_that_of_the_actuator) {
  start({.max_strength = 0.3});
  drive(1);
  drive(2);
  EXPECT_EQ(intensity(0), 74);  // step 9 of 31: the last within 0.3
  EXPECT_EQ(intensity(1), 74);
}

TEST_F(SafetyStageTest, answers_limited_if_the_limits_leave_nothing_that_turns_the_motor) {
  start({.max_strength = 0.1});
  EXPECT_EQ(drive(2), FeltOutcome::limited);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(safety->counters().refused_by_limit, 1U);
}

TEST_F(SafetyStageTest, tells_for_each_contact_what_is_left_of_it) {
  start({.max_strength = 0.1});
  const SafetyVerdict verdict = safety->apply(0, {{1, 1, now + 100ms}, {2, 1, now + 100ms}}, now);
  EXPECT_EQ(verdict.outcome, FeltOutcome::driven);
  const std::uint8_t first[]{1};
  const std::uint8_t second[]{2};
  const std::uint8_t both[]{1, 2};
  EXPECT_EQ(verdict.outcome_at(first), FeltOutcome::driven);
  EXPECT_EQ(verdict.outcome_at(second), FeltOutcome::limited);
  EXPECT_EQ(verdict.outcome_at(both), FeltOutcome::driven);
}

TEST_F(SafetyStageTest, turns_off_what_is_no_number) {
  drive(1);
  EXPECT_EQ(drive(1, std::numeric_limits<double>::quiet_NaN()), FeltOutcome::limited);
  EXPECT_THAT(running(), IsEmpty());
  drive(1);
  EXPECT_EQ(drive(1, std::numeric_limits<double>::infinity()), FeltOutcome::limited);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(safety->counters().refused_not_finite, 2U);
}

TEST_F(SafetyStageTest, refuses_an_unknown_actuator_and_drives_the_others) {
  const SafetyVerdict verdict = safety->apply(0, {{77, 1, now + 100ms}, {3, 1, now + 100ms}}, now);
  EXPECT_EQ(verdict.outcome, FeltOutcome::driven);
  EXPECT_THAT(verdict.refused, ElementsAre(77));
  EXPECT_THAT(running(), ElementsAre(2));
  EXPECT_EQ(safety->counters().refused_unknown_actuator, 1U);
}

TEST_F(SafetyStageTest, ends_each_drive_at_its_end) {
  drive(1, 1, 60ms);
  drive(3, 1, 160ms);
  live(50ms);
  EXPECT_THAT(running(), ElementsAre(0, 2));
  live(10ms);
  EXPECT_THAT(running(), ElementsAre(2));
  EXPECT_THAT(safety->running(), ElementsAre(3));
  live(100ms);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(safety->counters().off_expired, 2U);
}

TEST_F(SafetyStageTest, ends_a_drive_at_once_when_told) {
  drive(1);
  drive(1, 0, 0ms);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(safety->counters().off_ended, 1U);
}

TEST_F(SafetyStageTest, lets_no_drive_end_later_than_the_longest_drive) {
  drive(1, 1, 1h);
  live(240ms);
  EXPECT_THAT(running(), ElementsAre(0));
  live(10ms);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(safety->counters().clamped_end, 1U);
}

TEST_F(SafetyStageTest, renews_a_long_drive_without_a_gap_before_the_jacket_ends_it) {
  start({.longest_drive = 2s});
  drive(1, 1, 1900ms);
  for (int step = 0; step < 189; ++step) {
    live(10ms);
    ASSERT_THAT(running(), ElementsAre(0)) << step;
  }
  live(10ms);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_LE(jacket.frames.size(), 1900U / 50 + 2);
}

TEST_F(SafetyStageTest, mends_a_lost_frame_within_60_ms) {
  jacket.loses_frames = true;
  drive(1);
  jacket.loses_frames = false;
  live(60ms);
  EXPECT_THAT(running(), ElementsAre(0));
  jacket.loses_frames = true;
  drive(1, 0);
  jacket.loses_frames = false;
  EXPECT_THAT(running(), ElementsAre(0));
  live(60ms);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(SafetyStageTest, renews_before_a_command_runs_out_though_the_sender_vouched_for_it_only_lately) {
  start({.longest_drive = 2s, .heartbeat_timeout = 120ms});
  drive(1, 1, 2s);
  for (int step = 1; step <= 50; ++step) {
    now += 20ms;
    ASSERT_THAT(running(), ElementsAre(0)) << step;
    if (step % 5 == 0) safety->on_heartbeat(0, now);
    safety->tick(now);
  }
}

TEST_F(SafetyStageTest, is_off_without_the_senders_heartbeat) {
  start({.longest_drive = 2s});
  drive(1, 1, 2s);
  live_without_sender(240ms);
  EXPECT_THAT(running(), ElementsAre(0));
  live_without_sender(10ms);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_GE(jacket.stops, 1U);
  EXPECT_EQ(safety->counters().off_heartbeat_lost, 1U);
  EXPECT_EQ(drive(1), FeltOutcome::stale);
  EXPECT_EQ(safety->counters().refused_no_sender, 1U);
}

TEST_F(SafetyStageTest, is_off_without_the_senders_heartbeat_though_no_frame_gets_through_any_more) {
  start({.longest_drive = 2s});
  drive(1, 1, 2s);
  live_without_sender(100ms);
  jacket.loses_frames = true;
  live_without_sender(150ms);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(SafetyStageTest, does_not_take_up_an_old_drive_when_the_sender_comes_back) {
  start({.longest_drive = 2s});
  drive(1, 1, 2s);
  now += 300ms;
  safety->on_heartbeat(0, now);
  safety->tick(now);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(drive(1), FeltOutcome::driven);
}

TEST_F(SafetyStageTest, drives_nothing_before_the_first_heartbeat) {
  safety.reset();
  safety.emplace(std::make_unique<FakeJacketLink>(jacket), three_motors(), SafetyLimits{});
  safety->tick(now);
  EXPECT_EQ(drive(1), FeltOutcome::stale);
  EXPECT_THAT(jacket.frames, IsEmpty());
}

TEST_F(SafetyStageTest, stays_off_after_a_stop_until_it_is_resumed) {
  drive(1);
  safety->stop("the wearer pressed the button", now);
  EXPECT_THAT(running(), IsEmpty());
  safety->stop("another reason", now);
  EXPECT_EQ(safety->stop_reason(), "the wearer pressed the button");
  EXPECT_EQ(drive(1), FeltOutcome::stopped);
  live(500ms);
  EXPECT_EQ(drive(1), FeltOutcome::stopped);
  safety->resume();
  EXPECT_FALSE(safety->stopped());
  live(100ms);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(drive(1), FeltOutcome::driven);
}

TEST_F(SafetyStageTest, drives_again_after_an_all_off) {
  drive(1);
  safety->all_off(0, now);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(safety->counters().off_asked, 1U);
  EXPECT_EQ(drive(1), FeltOutcome::driven);
}

TEST_F(SafetyStageTest, answers_jacket_absent_while_there_is_none) {
  jacket.next_state = LinkState::absent;
  live(10ms);
  EXPECT_EQ(drive(1), FeltOutcome::jacket_absent);
  EXPECT_THAT(safety->running(), IsEmpty());
}

TEST_F(SafetyStageTest, answers_jacket_absent_as_soon_as_the_link_says_so_even_to_no_drives) {
  jacket.status.state = LinkState::absent;
  EXPECT_EQ(safety->apply(0, {}, now).outcome, FeltOutcome::jacket_absent);
}

TEST_F(SafetyStageTest, answers_jacket_absent_when_the_link_refuses_the_frame) {
  jacket.accepts_frames = false;
  EXPECT_EQ(drive(1), FeltOutcome::jacket_absent);
  EXPECT_THAT(safety->running(), IsEmpty());
}

TEST_F(SafetyStageTest, starts_with_an_all_off_after_every_reconnect_and_forgets_what_ran) {
  start({.longest_drive = 2s});
  drive(1, 1, 2s);
  jacket.next_state = LinkState::connecting;
  live(10ms);
  jacket.stops = 0;
  jacket.next_state = LinkState::armed;
  live(100ms);
  EXPECT_EQ(jacket.stops, 1U);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(safety->counters().off_link_lost, 1U);
}

TEST_F(SafetyStageTest, notices_a_reconnect_that_happens_within_one_poll) {
  start({.longest_drive = 2s});
  drive(1, 1, 2s);
  ++jacket.status.reconnects;
  live(10ms);
  EXPECT_EQ(jacket.stops, 1U);
  EXPECT_THAT(safety->running(), IsEmpty());
}

TEST_F(SafetyStageTest, drives_nothing_before_a_new_jacket_has_got_its_all_off) {
  jacket.next_state = LinkState::absent;
  live(10ms);
  jacket.status.state = LinkState::armed;  // armed, but no tick has seen it yet
  EXPECT_EQ(drive(1), FeltOutcome::jacket_absent);
}

TEST_F(SafetyStageTest, ends_everything_when_the_clock_jumps_back) {
  start({.longest_drive = 2s});
  drive(1, 1, 2s);
  now -= 10s;
  safety->tick(now);
  EXPECT_THAT(jacket.running(now), IsEmpty());
  EXPECT_EQ(safety->counters().off_clock_jumped, 1U);
  EXPECT_EQ(drive(1), FeltOutcome::stale);
  safety->on_heartbeat(0, now);
  EXPECT_EQ(drive(1), FeltOutcome::driven);
}

TEST_F(SafetyStageTest, ends_a_drive_that_runs_out_between_ticks_with_the_next_apply) {
  drive(1, 1, 50ms);
  now += 60ms;
  drive(3);
  for (const MotorCommand& command : jacket.frames.back().commands)
    EXPECT_NE(command.channel, 0);
}

TEST_F(SafetyStageTest, turns_everything_off_when_it_ends) {
  drive(1);
  safety.reset();
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(jacket.stops, 1U);
}

TEST(SafetyStage, refuses_limits_and_profiles_that_are_out_of_range) {
  FakeJacket jacket;
  const auto make = [&jacket](const JacketProfile& profile, SafetyLimits limits) {
    SafetyStage(std::make_unique<FakeJacketLink>(jacket), profile, limits);
  };
  const JacketProfile good = three_motors();
  EXPECT_NO_THROW(make(good, {}));
  EXPECT_THROW(make(good, {.max_strength = 1.1}), std::invalid_argument);
  EXPECT_THROW(make(good, {.max_strength = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(make(good, {.longest_drive = 0ms}), std::invalid_argument);
  EXPECT_THROW(make(good, {.longest_drive = 3s}), std::invalid_argument);
  EXPECT_THROW(make(good, {.heartbeat_timeout = 251ms}), std::invalid_argument);
  JacketProfile bad = good;
  bad.actuators[0].channel = 16;
  EXPECT_THROW(make(bad, {}), std::invalid_argument);
  bad = good;
  bad.actuators[0].max_strength = std::nan("");
  EXPECT_THROW(make(bad, {}), std::invalid_argument);
  bad.actuators.clear();
  EXPECT_THROW(make(bad, {}), std::invalid_argument);
  EXPECT_THROW(SafetyStage(nullptr, good, {}), std::invalid_argument);
}

}  // namespace
}  // namespace telehug
