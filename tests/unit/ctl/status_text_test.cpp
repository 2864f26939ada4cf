// SPDX-License-Identifier: Apache-2.0
#include "ctl/status_text.hpp"

#include <gmock/gmock.h>

#include <random>

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

TEST(StatusText, SaysWhatIsWrongAndWhatToDo) {
  const std::string text = status_text({{"side", "active"},
                                        {"state", "waiting"},
                                        {"version", "0.1.0"},
                                        {"uptime_s", 7260},
                                        {"problems", {{{"what", "no camera"}, {"do", "plug one in"}}}}});
  EXPECT_EQ(text,
            "active side: waiting (0.1.0, up 2 h 1 min)\n"
            "  problem      no camera\n"
            "               -> plug one in\n");
}

TEST(StatusText, ShowsPeerCameraCountersAndLatencies) {
  const std::string text = status_text(
      {{"side", "active"},
       {"peer",
        {{"connected", true}, {"round_trip_ms", 1.5}, {"one_way_ms", 0.75}, {"stopped", true}, {"reason", "bed time"}}},
       {"camera", {{"name", "C920"}, {"open", false}, {"why", "no peer"}}},
       {"counters", {{"touches", 12}}},
       {"latency_ms", {{"finger", {{"p50", 1.25}, {"p99", 2.5}, {"max", 3.0}, {"count", 100}}}}}});
  EXPECT_THAT(text, HasSubstr("peer         connected, stopped: bed time, round trip 1.5 ms, to here 0.75 ms\n"));
  EXPECT_THAT(text, HasSubstr("camera       C920, closed: no peer\n"));
  EXPECT_THAT(text, testing::ContainsRegex("touches +12\n"));
  EXPECT_THAT(text, testing::ContainsRegex("finger +1.250 +2.500 +3.000 +100\n"));
}

TEST(StatusText, ShowsEachOfSeveralPeersOnce) {
  const std::string text = status_text(
      {{"peer", {{"connected", true}}},
       {"pair", {{"name", "Dad"}}},
       {"link", {{"replaced", 0}}},
       {"peers",
        {{{"name", "Dad"}, {"connected", true}, {"one_way_ms", 3}}, {{"name", "Grandma"}, {"connected", false}}}}});
  EXPECT_THAT(text, HasSubstr("peer         Dad: connected, to here 3 ms\n"));
  EXPECT_THAT(text, HasSubstr("peer         Grandma: not connected\n"));
  EXPECT_THAT(text, Not(HasSubstr("replaced")));
}

TEST(StatusText, SaysWhatTheLastTouchWas) {
  const std::string text = status_text({{"last_touch", {{"box", 7}, {"gesture", "stroke"}, {"phase", "up"}}}});
  EXPECT_THAT(text, HasSubstr("last touch   stroke, box 7, phase up\n"));
}

TEST(StatusText, LeavesPlacesToPrograms) {
  const std::string text = status_text({{"face", {{"found", true}, {"places_px", {{"x", 1}}}}},
                                        {"touch_screen", {{"width_mm", 380}, {"reach_mm", {{8, 300}, {12, 294}}}}}});
  EXPECT_THAT(text, HasSubstr("face         found yes\n"));
  EXPECT_THAT(text, HasSubstr("touch_screen width_mm 380\n"));
}

TEST(StatusText, ShowsPartsItDoesNotKnow) {
  const std::string text = status_text({{"heater", {{"name", "left"}, {"celsius", 31}}}, {"mood", "calm"}});
  EXPECT_THAT(text, HasSubstr("heater       left, celsius 31\n"));
  EXPECT_THAT(text, HasSubstr("mood         calm\n"));
}

TEST(StatusText, TellsOfEveryHeaterInOneLine) {
  const std::string text = status_text(
      {{"jacket", {{"name", "coat"}, {"supply_v", 4.9}, {"heaters", {{{"celsius", 36.5}, {"fault", "none"}}}}}},
       {"heaters",
        {{{"id", 21}, {"name", "left"}, {"state", "ready"}, {"set_point_celsius", 36.9}, {"celsius", 33.44}},
         {{"id", 22}, {"name", "right"}, {"set_point_celsius", 0}, {"celsius", 30.5}, {"why", "no hand warms it"}},
         {{"id", 23}, {"name", "back"}, {"set_point_celsius", 0.0}, {"why", "it was too hot"}}}}});
  EXPECT_THAT(text, HasSubstr("  jacket       coat, supply_v 4.9\n"
                              "  heater       left: 33.4 C, set-point 36.9 C\n"
                              "  heater       right: 30.5 C, off: no hand warms it\n"
                              "  heater       back: no reading, off: it was too hot\n"));
}

TEST(StatusText, TellsOfMotorsThatHaveUsedUpSomeOfTheirDuty) {
  const auto motor = [](int id, double used) { return Json{{"id", id}, {"used", used}}; };
  const std::string text = status_text({{"duty", {motor(1, 0), motor(3, 0.254), motor(5, 1)}}});
  EXPECT_THAT(text, HasSubstr("  duty used    motor 3 25 %, motor 5 100 %\n"));
  EXPECT_THAT(status_text({{"duty", {motor(1, 0)}}}), Not(HasSubstr("duty")));
}

TEST(StatusText, SaysWhyNothingIsFelt) {
  const std::string text =
      status_text({{"consent", {{"name", "paused"}, {"why", "until 15:30"}, {"muted_boxes", {8}}}}});
  EXPECT_THAT(text, HasSubstr("consent      paused: until 15:30, muted_boxes [8]\n"));
}

TEST(StatusText, ShowsEachOfSeveralPartsItDoesNotKnow) {
  const std::string text = status_text({{"moods", {{{"name", "left"}, {"calm", true}}, {{"name", "right"}}}}});
  EXPECT_THAT(text, HasSubstr("moods        left, calm yes\n"));
  EXPECT_THAT(text, HasSubstr("moods        right\n"));
}

TEST(StatusText, LetsNoControlCharacterThrough) {
  const std::string text = status_text({{"peer", {{"connected", false}, {"reason", "\x1b]0;x\x07\n"}}}});
  EXPECT_THAT(text, Not(HasSubstr("\x1b")));
  EXPECT_THAT(text, HasSubstr("not connected: ?]0;x??"));
}

TEST(StatusText, LeavesOutWhatSaysNothing) {
  const std::string text = status_text({{"side", "active"},
                                        {"camera", {{"name", "virtual"}, {"open", false}, {"problems", Json::array()}}},
                                        {"face", {{"finder", ""}, {"found", false}, {"pinned", nullptr}}}});
  EXPECT_THAT(text, HasSubstr("virtual, closed\n"));
  EXPECT_THAT(text, HasSubstr("found no\n"));
}

TEST(StatusText, BearsPartsOfAnyType) {
  const std::vector<Json> values{nullptr,
                                 true,
                                 -3,
                                 1e300,
                                 "text",
                                 Json::array({1, "a", nullptr}),
                                 Json::object(),
                                 Json{{"connected", "perhaps"}, {"open", 3}, {"p50", {1}}}};
  const std::vector<std::string> names{"side",   "state",  "version", "uptime_s", "problems",   "peer",       "peers",
                                       "camera", "jacket", "heaters", "counters", "latency_ms", "last_touch", "duty"};
  std::mt19937 random(3);
  for (int round = 0; round < 2000; ++round) {
    Json status = Json::object();
    for (const auto& name : names)
      status[name] = values[random() % values.size()];
    EXPECT_FALSE(status_text(status).empty());
  }
  for (const Json& value : values)
    EXPECT_FALSE(status_text(value).empty());
}

}  // namespace
}  // namespace telehug
