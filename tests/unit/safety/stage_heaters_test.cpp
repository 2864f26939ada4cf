// SPDX-License-Identifier: Apache-2.0
//
// The safety stage and heaters: a drive of one is a set-point, under its supervision.
#include <gmock/gmock.h>

#include "unit/jacket/safety_stage_fixture.hpp"

namespace telehug {
namespace {

using protocol::HeaterFault;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A motor (1) and two heaters (8, 9); the second one gets no warmer than 36 C.
class SafetyStageWithHeaters : public SafetyStageTest {
 protected:
  SafetyStageWithHeaters() { start_with({}); }

  void start_with(SafetyLimits limits) {
    JacketProfile profile = profile_of({motor(1, {}, {1}), heater(8, 0), heater(9, 1)});
    profile.actuators[2].max_celsius = 36;
    safety.reset();
    jacket.heat_frames.clear();
    tell(30);
    safety.emplace(std::make_unique<FakeJacketLink>(jacket), profile, limits);
    safety->tick(now);
    safety->on_heartbeat(0, now);
    jacket.stops = 0;
  }
  static Actuator heater(std::uint8_t id, std::uint8_t channel) {
    Actuator made = motor(id, {}, {});
    made.kind = ActuatorKind::heater;
    made.channel = channel;
    return made;
  }
  // Telemetry of both heaters that has just come.
  void tell(std::optional<double> celsius, HeaterFault fault = HeaterFault::none) {
    jacket.status.telemetry.emplace();
    jacket.status.telemetry->heard = now;
    jacket.status.telemetry->heaters = {{celsius, fault}, {celsius, fault}};
  }
  // Time passes with telemetry, heartbeats and ticks.
  void stay_warm(Duration duration) {
    for (Duration passed{}; passed < duration; passed += 50ms) {
      tell(35);
      live(50ms);
    }
  }
  [[nodiscard]] double heats(std::size_t channel) const { return jacket.celsius(channel, now); }
};

TEST_F(SafetyStageWithHeaters, heats_to_a_set_point_that_goes_with_strength) {
  EXPECT_EQ(drive(8), FeltOutcome::driven);
  EXPECT_DOUBLE_EQ(heats(0), 40);
  EXPECT_THAT(safety->running(), ElementsAre(8));
  drive(8, 0.5);
  EXPECT_DOUBLE_EQ(heats(0), 36);
  drive(9);
  EXPECT_DOUBLE_EQ(heats(1), 36);
  EXPECT_THAT(jacket.frames, IsEmpty()) << "no motor has anything to do with it";
}

TEST_F(SafetyStageWithHeaters, keeps_the_limit_of_all_heaters) {
  start_with({.max_celsius = 35});
  drive(8);
  drive(9);
  EXPECT_DOUBLE_EQ(heats(0), 35);
  EXPECT_DOUBLE_EQ(heats(1), 35);
  start_with({.max_celsius = 30});
  EXPECT_EQ(drive(8), FeltOutcome::limited);
  start_with({.max_strength = 0.5});
  drive(8);
  EXPECT_DOUBLE_EQ(heats(0), 36);
  start_with({.max_strength = 0});
  EXPECT_EQ(drive(8), FeltOutcome::limited);
  EXPECT_THROW(start_with({.max_celsius = 41}), std::invalid_argument);
}

TEST_F(SafetyStageWithHeaters, renews_a_long_drive_and_ends_it) {
  start_with({.longest_drive = 2s});
  drive(8, 1, 1s);
  for (int i = 0; i < 19; ++i) {
    stay_warm(50ms);
    ASSERT_DOUBLE_EQ(heats(0), 40) << i;
  }
  stay_warm(50ms);
  EXPECT_EQ(heats(0), 0);
  for (const FakeJacket::HeatFrame& frame : jacket.heat_frames)
    for (const HeaterCommand& command : frame.commands)
      EXPECT_LE(command.duration, 250ms);
}

TEST_F(SafetyStageWithHeaters, is_off_without_the_senders_heartbeat) {
  start_with({.longest_drive = 2s});
  drive(8, 1, 2s);
  live_without_sender(250ms);
  EXPECT_EQ(heats(0), 0);
  EXPECT_GE(jacket.stops, 1U);
}

TEST_F(SafetyStageWithHeaters, is_off_when_stopped_or_paused) {
  drive(8);
  safety->stop("enough", now);
  EXPECT_EQ(heats(0), 0);
  safety->resume();
  drive(8);
  ASSERT_GT(heats(0), 0);
  Permission paused;
  paused.refusal = FeltOutcome::paused;
  safety->permit(paused, now);
  EXPECT_EQ(heats(0), 0);
}

TEST_F(SafetyStageWithHeaters, heats_nothing_without_a_valid_temperature) {
  tell(std::nullopt);
  EXPECT_EQ(drive(8), FeltOutcome::limited);
  EXPECT_EQ(heats(0), 0);
  jacket.status.telemetry.reset();
  EXPECT_EQ(drive(8), FeltOutcome::limited);
  EXPECT_THAT(safety->running(), IsEmpty());
  EXPECT_EQ(safety->counters().limited_by_heater, 2U);
}

TEST_F(SafetyStageWithHeaters, turns_a_heater_off_with_the_next_tick_when_it_becomes_faulty) {
  start_with({.longest_drive = 2s});
  drive(8, 1, 2s);
  live(10ms);
  ASSERT_GT(heats(0), 0);
  tell(30, HeaterFault::no_rise);
  live(10ms);
  EXPECT_EQ(heats(0), 0);
  EXPECT_THAT(safety->running(), IsEmpty());
  const HeaterReports reports = safety->heaters();
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_EQ(reports[0].id, 8);
  EXPECT_EQ(reports[0].state, HeaterState::fault);
  EXPECT_EQ(reports[0].fault, HeaterFault::no_rise);
  EXPECT_EQ(reports[0].set_point_celsius, 0);
}

TEST_F(SafetyStageWithHeaters, turns_a_heater_off_when_its_telemetry_gets_older_than_2_s) {
  start_with({.longest_drive = 2s});
  for (int i = 0; i < 10; ++i) {
    drive(8, 1, 2s);
    live(200ms);
  }
  EXPECT_GT(heats(0), 0);
  drive(8, 1, 2s);
  live(10ms);
  EXPECT_EQ(heats(0), 0);
  EXPECT_EQ(safety->heaters().at(0).state, HeaterState::no_telemetry);
}

TEST_F(SafetyStageWithHeaters, reports_set_point_and_temperature) {
  drive(8);
  const HeaterReport report = safety->heaters().at(0);
  EXPECT_EQ(report.state, HeaterState::ready);
  EXPECT_DOUBLE_EQ(report.set_point_celsius, 40);
  EXPECT_EQ(report.celsius, 30);
}

TEST_F(SafetyStageWithHeaters, lets_no_heater_heat_for_more_than_10_minutes_and_then_for_5) {
  start_with({.longest_drive = 2s});
  const auto heat_on = [this] {
    tell(35);
    drive(8, 1, 2s);
    live(100ms);
    return heats(0) > 0;
  };
  Duration on{};
  while (heat_on() && on < 20min)
    on += 100ms;
  EXPECT_GE(on, 599s);
  EXPECT_LE(on, 600s);
  EXPECT_EQ(safety->heaters().at(0).state, HeaterState::cooling_down);
  Duration off{};
  while (!heat_on() && off < 20min)
    off += 100ms;
  EXPECT_GE(off, 299s);
  EXPECT_LE(off, 301s);
}

TEST_F(SafetyStageWithHeaters, answers_limited_if_the_jacket_takes_no_heat_and_drives_its_motors) {
  jacket.status.heater_count = 0;
  const SafetyVerdict verdict = safety->apply(0, {{1, 1, now + 100ms}, {8, 1, now + 100ms}}, now);
  EXPECT_EQ(verdict.outcome, FeltOutcome::driven);
  EXPECT_THAT(verdict.refused, ElementsAre(8));
  EXPECT_THAT(safety->running(), ElementsAre(1));
}

TEST_F(SafetyStageWithHeaters, mends_a_lost_end_within_60_ms) {
  drive(8);
  jacket.loses_frames = true;
  drive(8, 0);
  jacket.loses_frames = false;
  ASSERT_GT(heats(0), 0);
  live(60ms);
  EXPECT_EQ(heats(0), 0);
}

TEST_F(SafetyStageWithHeaters, heats_as_the_warmest_of_several_senders_asks) {
  safety->on_heartbeat(1, now);
  drive(8, 0.25);
  safety->apply(1, {{8, 0.75, now + 100ms}}, now);
  EXPECT_DOUBLE_EQ(heats(0), 38);
}

}  // namespace
}  // namespace telehug
