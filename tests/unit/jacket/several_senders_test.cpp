// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "unit/jacket/safety_stage_fixture.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

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

TEST_F(SafetyStageOfTwo, drives_as_strongly_as_the_strongest_asks_whichever_of_them_that_is) {
  drive_by(0, 1, 0.6);
  const int stronger = intensity(0);
  drive_by(1, 1, 0.3);
  EXPECT_EQ(intensity(0), stronger);
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
