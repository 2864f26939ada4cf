// SPDX-License-Identifier: Apache-2.0
//
// The safety stage under the budgets of duty and current, and with actuators that are switched off.
#include <gmock/gmock.h>

#include "unit/jacket/safety_stage_fixture.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class SafetyStageWithBudgets : public SafetyStageTest {
 protected:
  void start_with(const JacketProfile& its_profile) {
    safety.reset();
    jacket.frames.clear();
    safety.emplace(std::make_unique<FakeJacketLink>(jacket), its_profile, SafetyLimits{});
    safety->tick(now);
    safety->on_heartbeat(0, now);
  }
  // A finger that rests: a drive every 30 ms, a tick every 10.
  void hold(std::uint8_t actuator, Duration duration, double strength = 1) {
    for (Duration passed{}; passed < duration; passed += 30ms) {
      last = safety->apply(0, {{actuator, strength, now + 200ms}}, now).outcome;
      live(30ms);
    }
  }

  JacketProfile profile = three_motors();
  FeltOutcome last = FeltOutcome::driven;
};

TEST_F(SafetyStageWithBudgets, weakens_a_motor_whose_duty_is_used_up_then_answers_limited) {
  profile.actuators[0].max_duty = 0.3;
  profile.actuators[0].min_strength = 0.3;
  start_with(profile);
  hold(1, 2s);
  EXPECT_EQ(intensity(0), 255);
  EXPECT_EQ(safety->counters().limited_by_duty, 0U);
  hold(1, 900ms);
  EXPECT_LT(intensity(0), 255);
  EXPECT_GT(intensity(0), 0);
  EXPECT_EQ(last, FeltOutcome::driven);
  hold(1, 600ms);
  EXPECT_EQ(intensity(0), 0);
  EXPECT_EQ(last, FeltOutcome::limited);
  EXPECT_THAT(safety->running(), IsEmpty());
  EXPECT_GT(safety->counters().limited_by_duty, 0U);
  EXPECT_EQ(drive(3), FeltOutcome::driven) << "the others have budgets of their own";
}

TEST_F(SafetyStageWithBudgets, tells_how_much_of_its_duty_each_motor_has_used_up) {
  profile.actuators[0].max_duty = 0.3;
  start_with(profile);
  ASSERT_EQ(safety->duties().size(), 3U);
  EXPECT_EQ(safety->duties()[0].used, 0);
  hold(1, 900ms);
  const double used = safety->duties()[0].used;
  EXPECT_EQ(safety->duties()[0].id, 1);
  EXPECT_GT(used, 0.2);
  hold(1, 300ms);
  EXPECT_GT(safety->duties()[0].used, used);
  EXPECT_EQ(safety->duties()[1].used, 0) << "one without a limit";
}

TEST_F(SafetyStageWithBudgets, takes_up_a_motor_again_that_has_rested) {
  profile.actuators[0].max_duty = 0.3;
  profile.actuators[0].min_strength = 0.3;
  start_with(profile);
  hold(1, 4s);
  ASSERT_EQ(last, FeltOutcome::limited);
  live(10s);
  EXPECT_EQ(drive(1), FeltOutcome::driven);
  EXPECT_EQ(intensity(0), 255);
}

TEST_F(SafetyStageWithBudgets, counts_a_motor_that_is_renewed_only_for_as_long_as_it_ran) {
  profile.actuators[0].max_duty = 0.3;
  start_with(profile);
  for (int tap = 0; tap < 200; ++tap) {  // 30 ms of every 300
    safety->apply(0, {{1, 1, now + 200ms}}, now);
    ASSERT_EQ(intensity(0), 255) << tap;
    live(30ms);
    safety->apply(0, {{1, 0, now}}, now);
    live(270ms);
  }
}

TEST_F(SafetyStageWithBudgets, scales_all_motors_alike_to_what_the_supply_gives) {
  for (Actuator& actuator : profile.actuators)
    actuator.current_ma = 100;
  profile.supply_ma = 150;
  start_with(profile);
  const SafetyVerdict verdict = safety->apply(0, {{1, 1, now + 100ms}, {3, 1, now + 100ms}}, now);
  EXPECT_EQ(verdict.outcome, FeltOutcome::driven);
  EXPECT_THAT(verdict.refused, IsEmpty());
  EXPECT_EQ(intensity(0), 189);  // step 23 of 31: the last within 0.75
  EXPECT_EQ(intensity(2), 189);
  EXPECT_EQ(safety->counters().limited_by_current, 2U);
}

TEST_F(SafetyStageWithBudgets, weakens_what_runs_when_more_is_touched_and_strengthens_it_again) {
  for (Actuator& actuator : profile.actuators)
    actuator.current_ma = 100;
  profile.supply_ma = 100;
  start_with(profile);
  drive(1);
  EXPECT_EQ(intensity(0), 255);
  drive(3);
  EXPECT_EQ(intensity(0), 123);  // step 15 of 31
  drive(3, 0);
  EXPECT_EQ(intensity(0), 255);
}

TEST_F(SafetyStageWithBudgets, leaves_out_the_weakest_if_not_all_would_turn_and_says_that_it_is_limited) {
  for (Actuator& actuator : profile.actuators) {
    actuator.current_ma = 100;
    actuator.min_strength = 0.6;
    actuator.max_strength = 1;
  }
  profile.supply_ma = 100;
  start_with(profile);
  const SafetyVerdict verdict = safety->apply(0, {{1, 0.5, now + 100ms}, {3, 1, now + 100ms}}, now);
  EXPECT_EQ(verdict.outcome, FeltOutcome::driven);
  EXPECT_THAT(verdict.refused, ElementsAre(1));
  const std::uint8_t weak[]{1};
  EXPECT_EQ(verdict.outcome_at(weak), FeltOutcome::limited);
  EXPECT_THAT(running(), ElementsAre(2));
  EXPECT_THAT(safety->running(), ElementsAre(3));
}

TEST_F(SafetyStageWithBudgets, never_drives_an_actuator_that_the_profile_has_switched_off) {
  profile.actuators[0].enabled = false;
  start_with(profile);
  EXPECT_EQ(drive(1), FeltOutcome::muted);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(safety->counters().refused_muted, 1U);
  EXPECT_EQ(drive(3), FeltOutcome::driven);
}

TEST_F(SafetyStageWithBudgets, refuses_budgets_that_are_out_of_range) {
  const auto throws = [this](auto change) {
    JacketProfile bad = three_motors();
    change(bad);
    EXPECT_THROW(SafetyStage(std::make_unique<FakeJacketLink>(jacket), bad, SafetyLimits{}), std::invalid_argument);
  };
  throws([](JacketProfile& bad) { bad.supply_ma = -1; });
  throws([](JacketProfile& bad) { bad.duty_window = 0ms; });
  throws([](JacketProfile& bad) { bad.duty_window = 11min; });
  throws([](JacketProfile& bad) { bad.actuators[0].max_duty = 0; });
  throws([](JacketProfile& bad) { bad.actuators[0].current_ma = -1; });
  throws([](JacketProfile& bad) { bad.actuators[1].channel = 0; });
  throws([](JacketProfile& bad) {
    bad.actuators[1].kind = ActuatorKind::heater;
    bad.actuators[1].channel = 2;
  });
}

}  // namespace
}  // namespace telehug
