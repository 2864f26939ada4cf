// SPDX-License-Identifier: Apache-2.0
#include "safety/heater_supervision.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "jacket/jacket_profile.hpp"

namespace telehug {
namespace {

using protocol::HeaterFault;

constexpr Timestamp now = from_ns(100'000'000'000);

std::optional<JacketTelemetry> telemetry(std::optional<double> celsius, HeaterFault fault = HeaterFault::none,
                                         Timestamp heard = now) {
  JacketTelemetry told;
  told.heard = heard;
  told.heaters.push_back({celsius, fault});
  return told;
}

TEST(HeaterSupervision, lets_a_heater_heat_whose_temperature_is_known) {
  const HeaterSupervision heater(0);
  EXPECT_EQ(heater.state(telemetry(31.5), now), HeaterState::ready);
}

TEST(HeaterSupervision, wants_telemetry_of_this_heater_that_is_2_s_old_at_most) {
  const HeaterSupervision heater(0);
  EXPECT_EQ(heater.state(std::nullopt, now), HeaterState::no_telemetry);
  EXPECT_EQ(heater.state(telemetry(31, HeaterFault::none, now - 2s), now), HeaterState::ready);
  EXPECT_EQ(heater.state(telemetry(31, HeaterFault::none, now - 2001ms), now), HeaterState::no_telemetry);
  EXPECT_EQ(heater.state(telemetry(31, HeaterFault::none, now + 1ms), now), HeaterState::no_telemetry);
  EXPECT_EQ(HeaterSupervision(1).state(telemetry(31), now), HeaterState::no_telemetry);
}

TEST(HeaterSupervision, lets_no_heater_heat_without_a_valid_temperature) {
  const HeaterSupervision heater(0);
  EXPECT_EQ(heater.state(telemetry(std::nullopt), now), HeaterState::no_reading);
  EXPECT_EQ(heater.state(telemetry(std::numeric_limits<double>::quiet_NaN()), now), HeaterState::no_reading);
}

TEST(HeaterSupervision, lets_no_heater_heat_that_the_microcontroller_calls_faulty) {
  const HeaterSupervision heater(0);
  for (const HeaterFault fault : {HeaterFault::sensor_open, HeaterFault::sensor_short, HeaterFault::too_hot,
                                  HeaterFault::no_rise, HeaterFault::rises_too_fast}) {
    EXPECT_EQ(heater.state(telemetry(31, fault), now), HeaterState::fault);
    EXPECT_EQ(heater.reading(telemetry(31, fault), now)->fault, fault);
  }
  EXPECT_EQ(heater.state(telemetry(31, HeaterFault::cooling_down), now), HeaterState::cooling_down);
}

TEST(HeaterSupervision, lets_no_heater_heat_from_41_degrees_on) {
  const HeaterSupervision heater(0);
  EXPECT_EQ(heater.state(telemetry(40.9), now), HeaterState::ready);
  EXPECT_EQ(heater.state(telemetry(41.0), now), HeaterState::too_warm);
}

TEST(HeaterSupervision, cools_a_heater_down_for_5_minutes_after_10) {
  HeaterSupervision heater(0);
  heater.pass(true, 599s);
  EXPECT_EQ(heater.state(telemetry(31), now), HeaterState::ready);
  heater.pass(true, 1s);
  EXPECT_EQ(heater.state(telemetry(31), now), HeaterState::cooling_down);
  heater.pass(false, 299s);
  EXPECT_EQ(heater.state(telemetry(31), now), HeaterState::cooling_down);
  heater.pass(false, 1s);
  EXPECT_EQ(heater.state(telemetry(31), now), HeaterState::ready);
}

TEST(HeaterSupervision, is_not_fooled_by_short_breaks) {
  HeaterSupervision heater(0);
  int seconds = 0;
  while (heater.state(telemetry(31), now) == HeaterState::ready) {
    heater.pass(true, 60s);
    heater.pass(false, 1s);
    seconds += 60;
  }
  EXPECT_LE(seconds, 660);
}

TEST(HeaterSupervision, is_not_worn_out_by_a_heater_that_heats_a_third_of_the_time) {
  HeaterSupervision heater(0);
  for (int i = 0; i < 1000; ++i) {
    heater.pass(true, 60s);
    ASSERT_EQ(heater.state(telemetry(31), now), HeaterState::ready);
    heater.pass(false, 60s);
  }
}

TEST(HeaterSupervision, takes_no_harm_from_times_that_are_none) {
  HeaterSupervision heater(0);
  heater.pass(true, -1h);
  heater.pass(false, Duration::max());
  heater.pass(true, Duration{});
  EXPECT_EQ(heater.state(telemetry(31), now), HeaterState::ready);
}

TEST(SetPoint, goes_with_strength_from_what_is_felt_as_warm_to_the_limit) {
  EXPECT_DOUBLE_EQ(set_point_celsius(1, 38), 38);
  EXPECT_DOUBLE_EQ(set_point_celsius(0.5, 38), 35);
  EXPECT_DOUBLE_EQ(set_point_celsius(1e-9, 38), least_celsius);
}

TEST(SetPoint, is_never_above_40_nor_above_the_limit_when_it_is_sent_in_tenths) {
  EXPECT_DOUBLE_EQ(set_point_celsius(1, 45), 40);
  EXPECT_DOUBLE_EQ(set_point_celsius(1e300, 41), 40);
  EXPECT_DOUBLE_EQ(set_point_celsius(1, 38.27), 38.2);
}

TEST(SetPoint, is_off_if_nothing_is_left) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double strength : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(set_point_celsius(strength, 40), 0) << strength;
  EXPECT_EQ(set_point_celsius(1, 31.9), 0);
  EXPECT_EQ(set_point_celsius(1, nan), 0);
}

}  // namespace
}  // namespace telehug
