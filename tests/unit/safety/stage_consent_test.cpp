// SPDX-License-Identifier: Apache-2.0
//
// The safety stage and what the wearer wants.
#include <gmock/gmock.h>

#include <limits>

#include "unit/jacket/safety_stage_fixture.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class SafetyStageWithConsent : public SafetyStageTest {
 protected:
  void refuse(FeltOutcome why) {
    Permission permission;
    permission.refusal = why;
    safety->permit(permission, now);
  }
  void mute_box(std::size_t box) {
    Permission permission;
    permission.muted_boxes.set(box);
    safety->permit(permission, now);
  }
  void mute(std::uint8_t actuator) {
    Permission permission;
    permission.muted_actuators.set(actuator);
    safety->permit(permission, now);
  }
};

TEST_F(SafetyStageWithConsent, ends_what_runs_as_soon_as_it_is_paused) {
  drive(1);
  refuse(FeltOutcome::paused);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_THAT(safety->running(), IsEmpty());
  EXPECT_EQ(safety->counters().off_consent, 1U);
}

TEST_F(SafetyStageWithConsent, drives_nothing_while_paused_or_quiet_and_says_which) {
  refuse(FeltOutcome::paused);
  EXPECT_EQ(drive(1), FeltOutcome::paused);
  refuse(FeltOutcome::quiet_hours);
  EXPECT_EQ(drive(1), FeltOutcome::quiet_hours);
  live(500ms);
  EXPECT_THAT(jacket.frames, IsEmpty());
  EXPECT_EQ(safety->counters().refused_paused, 1U);
  EXPECT_EQ(safety->counters().refused_quiet_hours, 1U);
}

TEST_F(SafetyStageWithConsent, takes_up_nothing_by_itself_when_a_pause_ends) {
  start({.longest_drive = 2s});
  drive(1, 1, 2s);
  refuse(FeltOutcome::paused);
  live(100ms);
  safety->permit({}, now);
  live(100ms);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(drive(1), FeltOutcome::driven);
}

TEST_F(SafetyStageWithConsent, is_stopped_beside_being_paused) {
  safety->stop("enough", now);
  refuse(FeltOutcome::paused);
  EXPECT_EQ(drive(1), FeltOutcome::stopped);
  safety->resume();
  EXPECT_EQ(drive(1), FeltOutcome::paused) << "a resume ends no pause";
  safety->stop("enough", now);
  safety->permit({}, now);
  EXPECT_EQ(drive(1), FeltOutcome::stopped) << "and the end of a pause no stop";
}

TEST_F(SafetyStageWithConsent, says_that_it_is_paused_though_no_jacket_answers) {
  jacket.next_state = LinkState::absent;
  live(10ms);
  refuse(FeltOutcome::paused);
  EXPECT_EQ(drive(1), FeltOutcome::paused);
}

TEST_F(SafetyStageWithConsent, drives_no_muted_actuator_and_ends_it_at_once) {
  start({.longest_drive = 2s});
  drive(1, 1, 2s);
  drive(3, 1, 2s);
  mute(1);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(drive(1), FeltOutcome::muted);
  EXPECT_EQ(drive(3), FeltOutcome::driven);
  EXPECT_THAT(running(), ElementsAre(2));
}

TEST_F(SafetyStageWithConsent, drives_no_actuator_that_lies_in_a_muted_box_and_ends_it_at_once) {
  JacketProfile profile = three_motors();
  profile.actuators[0].place = middle_of(7);
  profile.actuators[1].place = middle_of(8);
  profile.actuators[2].place = middle_of(8);
  profile.actuators[2].side = BodySide::back;
  Actuator pad = motor(4, middle_of(8), {});
  pad.kind = ActuatorKind::heater;
  pad.channel = 0;
  profile.actuators.push_back(pad);
  start({.longest_drive = 2s}, profile);
  jacket.status.telemetry = JacketTelemetry{.heard = now, .heaters = {{33.0, protocol::HeaterFault::none}}};
  constexpr std::uint8_t outside = 1;
  constexpr std::uint8_t inside[]{2, 3, 4};
  ASSERT_EQ(drive(outside, 1, 2s), FeltOutcome::driven);
  for (const std::uint8_t id : inside)
    ASSERT_EQ(drive(id, 1, 2s), FeltOutcome::driven);
  mute_box(8);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(jacket.celsius(0, now), 0);
  for (const std::uint8_t id : inside)
    EXPECT_EQ(drive(id), FeltOutcome::muted) << int{id};
  EXPECT_EQ(drive(outside), FeltOutcome::driven);
  live(100ms);
  EXPECT_THAT(running(), ElementsAre(0));
  EXPECT_EQ(jacket.celsius(0, now), 0);
  mute_box(13);
  EXPECT_EQ(drive(2), FeltOutcome::driven) << "the next box may do what this one may not";
}

TEST_F(SafetyStageWithConsent, says_that_a_muted_actuator_is_muted_when_its_touch_ends_as_well) {
  mute(1);
  EXPECT_EQ(safety->apply(0, {{1, 0, now}}, now).outcome, FeltOutcome::muted);
}

TEST_F(SafetyStageWithConsent, tells_for_each_contact_whether_it_was_muted_or_limited) {
  start({.max_strength = 0.1});
  mute(1);
  const SafetyVerdict verdict = safety->apply(0, {{1, 1, now + 100ms}, {2, 1, now + 100ms}, {3, 1, now + 100ms}}, now);
  const std::uint8_t muted[]{1};
  const std::uint8_t limited[]{2};
  const std::uint8_t neither[]{1, 2};
  const std::uint8_t felt[]{1, 3};
  EXPECT_EQ(verdict.outcome_at(muted), FeltOutcome::muted);
  EXPECT_EQ(verdict.outcome_at(limited), FeltOutcome::limited);
  EXPECT_EQ(verdict.outcome_at(neither), FeltOutcome::limited);
  EXPECT_EQ(verdict.outcome_at(felt), FeltOutcome::driven);
  EXPECT_EQ(safety->apply(0, {{1, 1, now + 100ms}, {2, 1, now + 100ms}}, now).outcome, FeltOutcome::limited);
}

TEST_F(SafetyStageWithConsent, drives_weaker_at_the_strength_that_the_wearer_wants_but_so_that_it_is_felt) {
  const auto driven_at = [this](double strength, std::uint8_t actuator) {
    Permission permission;
    permission.strength = strength;
    safety->permit(permission, now);
    EXPECT_EQ(drive(actuator), FeltOutcome::driven);
    return intensity(actuator - 1U);
  };
  constexpr double step = 255.0 / 31 + 1;  // of the microcontroller, and rounding
  const int whole = driven_at(1, 1);
  EXPECT_EQ(whole, 255);
  EXPECT_NEAR(driven_at(0.5, 1), whole / 2.0, step);
  EXPECT_GT(driven_at(0.01, 1), 0);
  // The second motor turns from 0.2 on and may have 0.4: what is wanted is spread over that.
  EXPECT_NEAR(driven_at(1, 2), 255 * 0.4, step);
  EXPECT_NEAR(driven_at(0.5, 2), 255 * 0.3, step);
  EXPECT_NEAR(driven_at(0.01, 2), 255 * 0.2, step);
}

TEST_F(SafetyStageWithConsent, is_never_stronger_than_its_limits_whatever_strength_is_wanted) {
  start({.max_strength = 0.3});
  for (const double strength : {0.0, 0.1, 0.5, 1.0, 2.0, 1e300, std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN(), -1.0}) {
    Permission permission;
    permission.strength = strength;
    safety->permit(permission, now);
    for (const double asked : {0.5, 1.0, 1e300}) {
      drive(1, asked);
      EXPECT_LE(intensity(0), 255 * 0.3) << strength;
    }
  }
}

TEST_F(SafetyStageWithConsent, ends_what_runs_when_another_strength_is_wanted) {
  drive(1);
  Permission permission;
  permission.strength = 0.5;
  safety->permit(permission, now);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(SafetyStageWithConsent, goes_on_with_what_runs_if_the_wearer_wants_nothing_else) {
  drive(1);
  safety->permit({}, now);
  EXPECT_THAT(running(), ElementsAre(0));
}

}  // namespace
}  // namespace telehug
