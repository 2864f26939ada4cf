// SPDX-License-Identifier: Apache-2.0
#include "jacket_status.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace telehug {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

LinkStatus armed_jacket() {
  LinkStatus link;
  link.state = LinkState::armed;
  link.device = "/dev/ttyUSB0";
  link.firmware_version = 3;
  link.motor_count = 12;
  link.heater_count = 2;
  link.telemetry.emplace();
  link.telemetry->supply_volts = 4.9;
  link.telemetry->reset_cause = 1;
  link.telemetry->frames_malformed = 6;
  link.telemetry->bytes_overrun = 2;
  link.telemetry->heaters = {{36.5, protocol::HeaterFault::none}, {std::nullopt, protocol::HeaterFault::sensor_open}};
  return link;
}

TEST(JacketStatus, TellsWhatTheJacketToldOfItself) {
  const std::vector<std::uint8_t> running{3, 9};
  EXPECT_EQ(jacket_json("coat", armed_jacket(), running),
            Json::parse(R"({"name": "coat", "device": "/dev/ttyUSB0", "state": "armed", "firmware": 3, "motors": 12,
                            "running": [3, 9], "supply_v": 4.9, "last_reset": "power-on", "frames_it_refused": 6,
                            "bytes_it_lost": 2, "heaters": [{"celsius": 36.5, "fault": "none"},
                                                            {"celsius": null, "fault": "sensor open"}]})"));
}

TEST(JacketStatus, TellsNothingThatIsNotKnown) {
  LinkStatus link = armed_jacket();
  link.telemetry->supply_volts = 0;
  link.telemetry->heaters.clear();
  const Json measured = jacket_json("coat", link, {});
  EXPECT_FALSE(measured.contains("supply_v"));
  EXPECT_FALSE(measured.contains("heaters"));
  link.telemetry.reset();
  EXPECT_FALSE(jacket_json("coat", link, {}).contains("last_reset"));
}

TEST(JacketStatus, SaysSoWhereNothingCanBeKnown) {
  EXPECT_FALSE(jacket_json("coat", armed_jacket(), {}).contains("note"));
  LinkStatus link = armed_jacket();
  link.answers = false;
  EXPECT_THAT(jacket_json("coat", link, {})["note"], HasSubstr("nobody knows"));
}

TEST(JacketStatus, HasNoProblemWithAJacketThatIsWell) {
  Json problems = Json::array();
  add_jacket_problems(problems, armed_jacket());
  EXPECT_EQ(problems, Json::array());
}

TEST(JacketStatus, TellsOfAJacketThatWorksBadly) {
  LinkStatus link = armed_jacket();
  link.telemetry->supply_volts = 4.2;
  link.telemetry->reset_cause = 4;
  Json problems = Json::array();
  add_jacket_problems(problems, link);
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_THAT(problems[0]["what"], HasSubstr("4.20 V"));
  EXPECT_THAT(problems[0]["do"], HasSubstr("charge its battery"));
  EXPECT_THAT(problems[1]["what"], HasSubstr("brown-out"));
}

TEST(JacketStatus, TellsWhyThereIsNoJacket) {
  LinkStatus link;
  link.device = "/dev/ttyUSB0";
  link.problem = "plug the jacket in";
  Json problems = Json::array();
  add_jacket_problems(problems, link);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0]["what"], "no jacket answers on /dev/ttyUSB0: plug the jacket in");
}

}  // namespace
}  // namespace telehug
