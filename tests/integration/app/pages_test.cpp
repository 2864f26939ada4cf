// SPDX-License-Identifier: Apache-2.0
//
// The wearer's pages as the daemon serves them: the way in, live data, and that what is ordered there is what the local
// socket orders.
#include <gmock/gmock.h>

#include "integration/app/running_pair.hpp"
#include "integration/web/raw_browser.hpp"

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
  [[nodiscard]] std::uint16_t port() const { return pair.status(Side::passive).at("web").at("port"); }
  [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(port()); }
  // By the command, as a person does it.
  void enter() {
    const Outcome opened = pair.telehug("open", Side::passive, {"--print"});
    ASSERT_EQ(opened.code, 0) << opened.text;
    const std::string start = "http://" + host();
    ASSERT_THAT(opened.text, StartsWith(start + "/enter?link="));
    const std::string path = opened.text.substr(start.size(), opened.text.find('\n') - start.size());
    const std::string answer = ask("GET " + path + " HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
    ASSERT_THAT(answer, HasSubstr("Location: /\r\n"));
    const auto begin = answer.find("telehug-passive=");
    ASSERT_NE(begin, std::string::npos);
    cookie = "Cookie: " + answer.substr(begin, answer.find(';', begin) - begin) + "\r\n";
  }
  [[nodiscard]] std::string get(const std::string& path) const {
    return "GET " + path + " HTTP/1.1\r\nHost: " + host() + "\r\n" + cookie + "\r\n";
  }
  [[nodiscard]] std::string ask(const std::string& request) const {
    RawBrowser browser(port());
    browser.send(request);
    return browser.read_answer();
  }
  [[nodiscard]] Json order(const Json& request) const {
    const std::string body = request.dump();
    const std::string answer =
        ask("POST /command HTTP/1.1\r\nHost: " + host() + "\r\nOrigin: http://" + host() +
            "\r\nContent-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" + cookie +
            "\r\n" + body);
    return Json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
  }

  RunningPair pair;
  std::string cookie;
};

TEST_F(TheWearersPages, OrderWhatTheLocalSocketOrdersAndNothingThatIsNotForPages) {
  start();
  enter();
  EXPECT_THAT(ask(get("/")), HasSubstr("<script type=\"module\" src=\"/body.js\">"));
  EXPECT_EQ(order({{"command", "pause"}}), Json({{"side", "passive"}, {"paused", true}}));
  EXPECT_EQ(pair.status(Side::passive).at("consent").at("name"), "paused");
  EXPECT_EQ(order({{"command", "unpause"}}).at("paused"), false);
  EXPECT_TRUE(order({{"command", "mute"}, {"boxes", {0}}}).contains("error"));
  EXPECT_TRUE(order({{"command", "open"}}).contains("error"));
  EXPECT_TRUE(order({{"command", "watch"}}).contains("error"));
}

TEST_F(TheWearersPages, FollowTheMotorsAndTheStatus) {
  start();
  enter();
  RawBrowser page(port());
  page.send(get("/live?topics=status,running"));
  EXPECT_THAT(page.read_until("event: status\ndata: {"), StartsWith("HTTP/1.1 200 "));
  ASSERT_TRUE(order({{"command", "jacket_trial"}, {"id", 3}, {"seconds", 0.5}}).contains("trial"));
  EXPECT_THAT(page.read_until("event: running\ndata: {\"actuators\":[3]}\n\n"), HasSubstr("[3]"));
  EXPECT_THAT(page.read_until("event: running\ndata: {\"actuators\":[]}\n\n"), HasSubstr("[]"));
}

TEST_F(TheWearersPages, KeepNobodyFromStoppingTheJacketByTheCommand) {
  start();
  enter();
  std::vector<RawBrowser> slow;
  for (int i = 0; i < 500; ++i) {
    slow.emplace_back(port());
    (void)slow.back().send("GET / HT");
  }
  EXPECT_EQ(pair.telehug("stop", Side::passive).code, 0);
  EXPECT_TRUE(eventually([this] { return pair.status(Side::passive).at("state") == "stopped"; })) << pair.logs();
  EXPECT_THAT(ask(get("/")), StartsWith("HTTP/1.1 200 "));
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
