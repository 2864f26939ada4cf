// SPDX-License-Identifier: Apache-2.0
//
// The active daemon as it is used, and in place of the wearer's one a program on Cyclone DDS.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "integration/app/running_pair.hpp"
#include "interop/cyclone_peer.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;
using EventContact = std::pair<std::uint64_t, std::uint32_t>;  // sequence of an event, id of a contact in it

class WearersSideOnCycloneDds : public testing::Test {
 protected:
  void SetUp() override {
    pair.camera = "virtual";
    pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
    pair.start_active();
    ASSERT_TRUE(eventually([&] { return pair.status(Side::active).is_object(); })) << pair.logs();
    watch.emplace(std::get<ControlClient>(ControlClient::connect(pair.socket(Side::active))));
    ASSERT_TRUE(watch->ask({{"command", "watch"}}));
    // The daemon opens the camera once it hears its heartbeats.
    wearer.emplace(pair.domain(), pair.partition(), "00112233445566778899aabbccddeeff");
  }

  // What the daemon told and what was heard since the last call.
  void listen() {
    auto event = watch->next(1ms);
    while (event && *event) {
      const std::string kind = (*event)->value("event", "");
      if (kind == "touch") told[key((**event).at("event_sequence"), (**event).at("contact"))] = **event;
      if (kind == "felt") felt[key((**event).at("event_sequence"), (**event).at("contact"))] = **event;
      event = watch->next(0ms);
    }
    for (Json touch = wearer->next("touch", 1ms); !touch.is_null(); touch = wearer->next("touch", 1ms)) {
      for (const Json& contact : touch.at("contacts"))
        note(touch.at("sequence"), touch.at("frame_time_ns"), contact);
      for (const Json& transition : touch.at("transitions"))
        note(transition.at("event_sequence"), transition.at("frame_time_ns"), transition.at("contact"));
    }
  }
  static EventContact key(const Json& sequence, const Json& contact) {
    return {sequence.get<std::uint64_t>(), contact.get<std::uint32_t>()};
  }
  void note(const Json& sequence, const Json& frame_time_ns, const Json& contact) {
    Json& noted = heard[key(sequence, contact.at("id"))];
    noted = contact;
    noted["frame_time_ns"] = frame_time_ns;
  }
  [[nodiscard]] static std::ptrdiff_t count(const std::map<EventContact, Json>& contacts, const std::string& phase) {
    return std::ranges::count_if(contacts, [&](const auto& entry) { return entry.second.at("phase") == phase; });
  }

  RunningPair pair;
  std::optional<ControlClient> watch;
  std::optional<CycloneWearer> wearer;
  std::map<EventContact, Json> told;
  std::map<EventContact, Json> heard;
  std::map<EventContact, Json> felt;
};

TEST_F(WearersSideOnCycloneDds, HearsWhatTheActiveDaemonSendsAndIsHeardByIt) {
  EXPECT_EQ(wearer->next("status").value("side", ""), "active") << pair.logs();
  EXPECT_EQ(wearer->next("heartbeat").value("side", ""), "active") << pair.logs();
  ASSERT_TRUE(eventually([&] { return listen(), count(heard, "up") >= 2 && felt.size() >= 10; }, 60s)) << pair.logs();

  std::ptrdiff_t compared = 0;
  for (const auto& [which, sent] : told) {
    const auto found = heard.find(which);
    if (found == heard.end()) continue;  // best effort
    ++compared;
    const Json& got = found->second;
    for (const auto& [in_status, on_the_wire] : {std::pair{"frame_time_ns", "frame_time_ns"},
                                                 {"phase", "phase"},
                                                 {"gesture", "gesture"},
                                                 {"box", "box"},
                                                 {"columns", "columns"},
                                                 {"rows", "rows"},
                                                 {"x_mm", "screen_x_mm"},
                                                 {"y_mm", "screen_y_mm"},
                                                 {"x_fh", "body_x_fh"},
                                                 {"y_fh", "body_y_fh"},
                                                 {"speed_mm_s", "speed_mm_s"}})
      EXPECT_EQ(got.at(on_the_wire), sent.at(in_status)) << in_status << " of event " << which.first;
  }
  EXPECT_GE(compared, 10) << told.size() << " told, " << heard.size() << " heard";
  EXPECT_GE(count(heard, "down"), 2);
  // It answers the first contact of each event with "driven", and the daemon believes it.
  for (const auto& [which, answer] : felt) {
    ASSERT_TRUE(heard.contains(which)) << "event " << which.first;
    EXPECT_EQ(answer.at("box"), heard.at(which).at("box"));
  }
  EXPECT_EQ(felt.begin()->second.at("outcome"), "driven");
  EXPECT_GE(pair.counter(Side::active, "events_published"), felt.size());
}

}  // namespace
}  // namespace telehug
