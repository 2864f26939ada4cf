// SPDX-License-Identifier: Apache-2.0
#include "link/jacket_telemetry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace telehug {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(JacketTelemetry, TellsWhyTheJacketStartedInWords) {
  EXPECT_EQ(reset_cause_text(1), "power-on");
  EXPECT_EQ(reset_cause_text(2), "reset line");
  EXPECT_EQ(reset_cause_text(5), "power-on, brown-out");
  EXPECT_EQ(reset_cause_text(8), "watchdog");
  EXPECT_EQ(reset_cause_text(0), "unknown");
}

TEST(JacketTelemetry, TellsOfEveryFaultOfAHeaterInWords) {
  using protocol::HeaterFault;
  EXPECT_EQ(heater_fault_text(HeaterFault::none), "none");
  EXPECT_EQ(heater_fault_text(HeaterFault::sensor_open), "sensor open");
  EXPECT_EQ(heater_fault_text(HeaterFault::cooling_down), "cooling down");
  EXPECT_EQ(heater_fault_text(static_cast<HeaterFault>(7)), "unknown fault 7");
}

TEST(JacketTelemetry, WarnsOfAWeakSupplyAndOnlyWhereItIsMeasured) {
  JacketTelemetry telemetry;
  telemetry.reset_cause = 1;
  EXPECT_THAT(warnings(telemetry), IsEmpty()) << "0 V is no measurement";
  telemetry.supply_volts = 4.5;
  EXPECT_THAT(warnings(telemetry), IsEmpty());
  telemetry.supply_volts = 4.49;
  ASSERT_EQ(warnings(telemetry).size(), 1U);
  EXPECT_THAT(warnings(telemetry)[0].what, HasSubstr("weak: 4.49 V"));
}

TEST(JacketTelemetry, WarnsOfAJacketThatHasStartedAgainByItself) {
  JacketTelemetry telemetry;
  telemetry.reset_cause = 8;
  ASSERT_EQ(warnings(telemetry).size(), 1U);
  EXPECT_THAT(warnings(telemetry)[0].what, HasSubstr("by itself (watchdog)"));
  EXPECT_THAT(warnings(telemetry)[0].to_do, HasSubstr("update its firmware"));
  telemetry.reset_cause = 4;
  ASSERT_EQ(warnings(telemetry).size(), 1U);
  EXPECT_THAT(warnings(telemetry)[0].to_do, HasSubstr("supply has sagged"));
  telemetry.reset_cause = 5;
  EXPECT_THAT(warnings(telemetry), IsEmpty()) << "switching on is no fault";
  telemetry.reset_cause = 2;
  EXPECT_THAT(warnings(telemetry), IsEmpty());
}

}  // namespace
}  // namespace telehug
