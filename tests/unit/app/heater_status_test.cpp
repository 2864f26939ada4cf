// SPDX-License-Identifier: Apache-2.0
#include "heater_status.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace telehug {
namespace {

using Json = nlohmann::json;
using protocol::HeaterFault;
using ::testing::HasSubstr;

HeaterReport cold_pad() {
  return {.id = 21, .state = HeaterState::ready, .fault = HeaterFault::none, .set_point_celsius = 0, .celsius = 30.52};
}

std::string why(const HeaterReport& heater, const HeaterSurroundings& around = {}) {
  return heater_json(heater, "flank", around).value("why", "");
}

TEST(HeaterStatus, TellsTemperatureAndSetPointOfOneThatHeats) {
  HeaterReport heater = cold_pad();
  heater.set_point_celsius = 36.9;
  EXPECT_EQ(heater_json(heater, "right flank, warm", {}),
            Json::parse(R"({"id": 21, "name": "right flank, warm", "state": "ready", "fault": "none",
                            "set_point_celsius": 36.9, "celsius": 30.5})"));
}

TEST(HeaterStatus, SaysWhyOneIsOff) {
  EXPECT_EQ(why(cold_pad()), "no hand warms it");
  EXPECT_EQ(why(cold_pad(), {.muted = true}), "the wearer has muted it");
  EXPECT_EQ(why(cold_pad(), {.refusal = "paused until 15:30", .muted = true}), "paused until 15:30");
  EXPECT_THAT(why(cold_pad(), {.refusal = "paused", .enabled = false}), HasSubstr("switched it off"));
}

TEST(HeaterStatus, NamesWhatIsWrongBeforeWhatTheWearerWants) {
  HeaterReport broken = cold_pad();
  broken.state = HeaterState::fault;
  broken.fault = HeaterFault::sensor_open;
  broken.celsius.reset();
  const Json json = heater_json(broken, "flank", {.refusal = "paused"});
  EXPECT_EQ(json.at("state"), "fault");
  EXPECT_EQ(json.at("fault"), "sensor open");
  EXPECT_EQ(json.at("why"), "its temperature sensor is not connected");
  EXPECT_FALSE(json.contains("celsius"));
}

TEST(HeaterStatus, BlamesTheMissingJacketRatherThanItsSilence) {
  HeaterReport silent = cold_pad();
  silent.state = HeaterState::no_telemetry;
  EXPECT_EQ(why(silent, {.jacket_answers = false}), "no jacket answers");
  EXPECT_THAT(why(silent), HasSubstr("for 2 s"));
}

TEST(HeaterStatus, HasASentenceOfItsOwnForEveryStateAndFaultThatKeepsOneOff) {
  std::set<std::string> sentences;
  for (const HeaterState state :
       {HeaterState::no_telemetry, HeaterState::no_reading, HeaterState::too_warm, HeaterState::cooling_down}) {
    HeaterReport heater = cold_pad();
    heater.state = state;
    sentences.insert(why(heater));
  }
  for (const HeaterFault fault : {HeaterFault::sensor_open, HeaterFault::sensor_short, HeaterFault::too_hot,
                                  HeaterFault::no_rise, HeaterFault::rises_too_fast, static_cast<HeaterFault>(200)}) {
    HeaterReport heater = cold_pad();
    heater.state = HeaterState::fault;
    heater.fault = fault;
    sentences.insert(why(heater));
  }
  EXPECT_EQ(sentences.size(), 10U);
  EXPECT_FALSE(sentences.contains(""));
}

TEST(HeaterStatus, TellsNoTemperatureThatIsNoNumber) {
  HeaterReport heater = cold_pad();
  heater.celsius = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(heater_json(heater, "flank", {}).contains("celsius"));
}

}  // namespace
}  // namespace telehug
