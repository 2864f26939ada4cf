// SPDX-License-Identifier: Apache-2.0
#include "safety/safety_stage.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "doubles/fake_jacket_link.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Three motors on channels 0, 1, 2; the second is weak.
JacketProfile three_motors() {
  JacketProfile profile = profile_of({motor(1, {}, {1}), motor(2, {}, {2}), motor(3, {}, {3})});
  profile.actuators[1].max_strength = 0.4;
  profile.actuators[1].min_strength = 0.2;
  return profile;
}

class SafetyStageTest : public ::testing::Test {
 protected:
  SafetyStageTest() { start({}); }

  void start(SafetyLimits limits) {
    safety.reset();
    safety.emplace(std::make_unique<FakeJacketLink>(jacket), three_motors(), limits);
    safety->tick(now);
    safety->on_heartbeat(0, now);
    jacket.stops = 0;
  }
  FeltOutcome drive(std::uint8_t actuator, double strength = 1, Duration duration = 200ms) {
    return safety->apply(0, {{actuator, strength, now + duration}}, now).outcome;
  }
  // The sender's heartbeat every 100 ms, a tick every 10 ms.
  void live(Duration duration) {
    for (Duration passed{}; passed < duration; passed += 10ms) {
      now += 10ms;
      if ((now - start_time) % 100ms == 0ms) safety->on_heartbeat(0, now);
      safety->tick(now);
    }
  }
  // Ticks, but not a word from the sender.
  void live_without_sender(Duration duration) {
    for (Duration passed{}; passed < duration; passed += 10ms) {
      now += 10ms;
      safety->tick(now);
    }
  }
  [[nodiscard]] std::vector<int> running() const { return jacket.running(now); }
  [[nodiscard]] int intensity(std::size_t channel) const { return jacket.intensity(channel, now); }

  const Timestamp start_time = from_ns(1'000'000'000);
  Timestamp now = start_time;
  FakeJacket jacket;
  std::optional<SafetyStage> safety;
};

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

// Two senders, both heard, each with a heartbeat every 100 ms.
class SafetyStageOfTwo : public SafetyStageTest {
 protected:
  SafetyStageOfTwo() { safety->on_heartbeat(1, now); }

  FeltOutcome drive_by(SenderNumber sender, std::uint8_t actuator, double strength, Duration duration = 200ms) {
    return safety->apply(sender, {{actuator, strength, now + duration}}, now).outcome;
  }
};

TEST_F(SafetyStageOfTwo, drives_as_strongly_as_the_strongest_asks_and_never_the_sum) {
  drive_by(0, 1, 0.3);
  const int weaker = intensity(0);
  drive_by(1, 1, 0.6);
  const int stronger = intensity(0);
  EXPECT_GT(stronger, weaker);
  drive_by(0, 1, 0.3);
  EXPECT_EQ(intensity(0), stronger);
  drive_by(1, 1, 0);
  EXPECT_EQ(intensity(0), weaker);
}

TEST_F(SafetyStageOfTwo, falls_back_to_the_weaker_when_the_stronger_drive_ends) {
  drive_by(0, 1, 0.3, 200ms);
  const int weaker = intensity(0);
  drive_by(1, 1, 1, 50ms);
  live(60ms);
  EXPECT_EQ(intensity(0), weaker);
  EXPECT_EQ(safety->counters().off_expired, 0U);
}

TEST_F(SafetyStageOfTwo, silences_only_the_one_whose_heartbeats_stop) {
  for (Duration passed{}; passed < 300ms; passed += 10ms) {
    now += 10ms;
    if ((now - start_time) % 100ms == 0ms) safety->on_heartbeat(0, now);
    drive_by(0, 1, 0.3);
    drive_by(1, 1, 1);
    drive_by(1, 3, 1);
    safety->tick(now);
  }
  EXPECT_THAT(safety->running(), ElementsAre(1));
  EXPECT_LT(intensity(0), 128);
  EXPECT_EQ(drive_by(1, 3, 1), FeltOutcome::stale);
  EXPECT_EQ(drive_by(0, 3, 1), FeltOutcome::driven);
}

TEST_F(SafetyStageOfTwo, lets_no_heartbeat_of_one_vouch_for_a_command_of_the_other) {
  now += 240ms;
  safety->on_heartbeat(0, now);
  drive_by(1, 1, 1, 200ms);  // heard last 240 ms ago: 10 ms are left
  ASSERT_EQ(jacket.frames.back().commands.size(), 1U);
  EXPECT_EQ(jacket.frames.back().commands[0].duration, 10ms);
}

TEST_F(SafetyStageOfTwo, turns_off_what_one_drives_and_not_what_the_other_does) {
  drive_by(0, 1, 1);
  drive_by(1, 3, 1);
  safety->all_off(0, now);
  EXPECT_THAT(safety->running(), ElementsAre(3));
  EXPECT_THAT(running(), ElementsAre(2));
  EXPECT_EQ(drive_by(0, 1, 1), FeltOutcome::driven);
  safety->forget(0, now);
  EXPECT_THAT(safety->running(), ElementsAre(3));
  EXPECT_EQ(drive_by(0, 1, 1), FeltOutcome::stale);
}

TEST_F(SafetyStageOfTwo, stops_both) {
  drive_by(0, 1, 1);
  drive_by(1, 3, 1);
  safety->stop("test", now);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(drive_by(1, 3, 1), FeltOutcome::stopped);
}

TEST_F(SafetyStageOfTwo, knows_nobody_beyond_its_last_number) {
  safety->on_heartbeat(max_senders, now);
  EXPECT_EQ(drive_by(max_senders, 1, 1), FeltOutcome::stale);
  EXPECT_THAT(running(), IsEmpty());
}

}  // namespace
}  // namespace telehug
