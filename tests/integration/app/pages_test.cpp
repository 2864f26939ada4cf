// SPDX-License-Identifier: Apache-2.0
//
// The wearer's pages as the daemon serves them: the way in, live data, and that what is ordered there is what the local
// socket orders.
#include <gmock/gmock.h>

#include "integration/app/entered_pages.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::json;

class TheWearersPages : public testing::Test {
 protected:
  void start() {
    pair.start_jacket();
    pair.start_passive();
    ASSERT_TRUE(eventually([this] { return pair.jacket_state() == "armed"; })) << pair.logs();
  }
  [[nodiscard]] EnteredPages enter() const { return {pair, Side::passive}; }

  RunningPair pair;
};

TEST_F(TheWearersPages, OrderWhatTheLocalSocketOrdersAndNothingThatIsNotForPages) {
  start();
  const EnteredPages pages = enter();
  EXPECT_THAT(pages.ask(pages.get("/")), HasSubstr("<script type=\"module\" src=\"/body.js\">"));
  EXPECT_EQ(pages.order({{"command", "pause"}}), Json({{"side", "passive"}, {"paused", true}}));
  EXPECT_EQ(pair.status(Side::passive).at("consent").at("name"), "paused");
  EXPECT_EQ(pages.order({{"command", "unpause"}}).at("paused"), false);
  EXPECT_TRUE(pages.order({{"command", "mute"}, {"boxes", {0}}}).contains("error"));
  EXPECT_TRUE(pages.order({{"command", "open"}}).contains("error"));
  EXPECT_TRUE(pages.order({{"command", "watch"}}).contains("error"));
}

TEST_F(TheWearersPages, FollowTheMotorsAndTheStatus) {
  start();
  const EnteredPages pages = enter();
  RawBrowser page = pages.follow("status,running");
  EXPECT_THAT(page.read_until("event: status\ndata: {"), StartsWith("HTTP/1.1 200 "));
  ASSERT_TRUE(pages.order({{"command", "jacket_trial"}, {"id", 3}, {"seconds", 0.5}}).contains("trial"));
  EXPECT_THAT(page.read_until("event: running\ndata: {\"actuators\":[3]}\n\n"), HasSubstr("[3]"));
  EXPECT_THAT(page.read_until("event: running\ndata: {\"actuators\":[]}\n\n"), HasSubstr("[]"));
}

TEST_F(TheWearersPages, KeepNobodyFromStoppingTheJacketByTheCommand) {
  start();
  const EnteredPages pages = enter();
  std::vector<RawBrowser> slow;
  for (int i = 0; i < 500; ++i) {
    slow.emplace_back(pages.port());
    (void)slow.back().send("GET / HT");
  }
  EXPECT_EQ(pair.telehug("stop", Side::passive).code, 0);
  EXPECT_TRUE(eventually([this] { return pair.status(Side::passive).at("state") == "stopped"; })) << pair.logs();
  EXPECT_THAT(pages.ask(pages.get("/")), StartsWith("HTTP/1.1 200 "));
}

TEST_F(TheWearersPages, AreNotThereIfTheyAreSwitchedOff) {
  pair.passive_settings = {"web.enabled=false"};
  start();
  EXPECT_FALSE(pair.status(Side::passive).contains("web"));
  const Outcome refused = pair.telehug("open", Side::passive, {"--print"});
  EXPECT_EQ(refused.code, 9);
  EXPECT_THAT(refused.text, HasSubstr("set web.enabled to true"));
}

TEST_F(TheWearersPages, DoNotKeepTheDaemonFromWorkingIfTheirPortIsTaken) {
  RunningPair other;
  other.start_passive();
  ASSERT_TRUE(eventually([&] { return other.status(Side::passive).is_object(); }));
  pair.passive_settings = {"web.port=" + other.status(Side::passive).at("web").at("port").dump()};
  start();
  EXPECT_TRUE(pair.complains(Side::passive, "the pages can't be served on port "));
  EXPECT_EQ(pair.telehug("open", Side::passive, {"--print"}).code, 9);
}

}  // namespace
}  // namespace telehug
