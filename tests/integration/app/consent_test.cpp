// SPDX-License-Identifier: Apache-2.0
//
// What the wearer wants counts on the pins, at once, and after a restart; and the other side is told.
#include <gtest/gtest.h>

#include <fstream>

#include "integration/app/running_pair.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

class WearersConsent : public testing::Test {
 protected:
  [[nodiscard]] Json consent() const {
    const Json answer = pair.status(Side::passive);
    return answer.is_object() ? answer.at("consent") : Json();
  }
  [[nodiscard]] bool is(const std::string& name) const {
    const Json told = consent();
    return told.is_object() && told.at("name") == name;
  }
  [[nodiscard]] bool connected() const {
    const Json answer = pair.status(Side::passive);
    return answer.is_object() && answer.at("peer").at("connected").get<bool>();
  }

  RunningPair pair;
};

TEST_F(WearersConsent, PausesAtOnceAndIsKeptOverARestartUntilItIsEnded) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  const auto silence_ms = pair.ms_to_silence([this] { ASSERT_EQ(pair.telehug("pause", Side::passive).code, 0); });
  ASSERT_TRUE(silence_ms) << pair.logs();
  EXPECT_TRUE(pair.complains(Side::passive, "paused until further notice")) << pair.logs();
  EXPECT_EQ(pair.status(Side::passive).at("state"), "paused");
  EXPECT_TRUE(eventually([this] { return pair.complains(Side::active, "is not ready: paused until further notice"); }))
      << pair.logs();
  EXPECT_TRUE(eventually([this] { return pair.counter(Side::passive, "safety_refused_paused") > 0; })) << pair.logs();
  const auto changes = pair.pins().size();

  pair.passive->kill_now();
  pair.start_passive();
  ASSERT_TRUE(eventually([this] { return connected(); })) << pair.logs();
  EXPECT_TRUE(eventually([this] { return pair.counter(Side::passive, "safety_refused_paused") > 0; })) << pair.logs();
  EXPECT_EQ(pair.pins().size(), changes) << pair.logs();
  EXPECT_EQ(pair.telehug("resume", Side::passive).code, 0);
  EXPECT_TRUE(is("paused")) << "that is no stop";

  ASSERT_EQ(pair.telehug("unpause", Side::passive).code, 0);
  EXPECT_TRUE(eventually([this] { return pair.felt(); })) << pair.logs();
  EXPECT_TRUE(is("open"));
}

TEST_F(WearersConsent, PausesForSomeMinutesAndTellsUntilWhen) {
  pair.start_jacket();
  pair.start_passive();
  ASSERT_TRUE(eventually([this] { return is("open"); })) << pair.logs();
  ASSERT_EQ(pair.telehug("pause", Side::passive, {"30"}).code, 0);
  EXPECT_TRUE(consent().at("why").get<std::string>().starts_with("until ")) << consent();
  EXPECT_EQ(pair.telehug("pause", Side::passive, {"0"}).code, 2);
}

TEST_F(WearersConsent, FeelsNothingInQuietHours) {
  // All day, so that the test may run at any time.
  pair.passive_settings.emplace_back("consent.quiet_hours=00:00-12:00,12:00-24:00");
  pair.start_jacket();
  pair.start_passive();
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  pair.start_active();
  EXPECT_TRUE(eventually([this] { return pair.counter(Side::passive, "safety_refused_quiet_hours") > 0; }))
      << pair.logs();
  EXPECT_TRUE(is("quiet hours"));
  EXPECT_TRUE(eventually([this] { return pair.complains(Side::active, "is not ready: quiet hours until "); }))
      << pair.logs();
  EXPECT_TRUE(pair.pins().empty()) << pair.logs();
}

TEST_F(WearersConsent, FeelsNothingInAMutedBoxUntilItIsUnmuted) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  const Json touch = pair.status(Side::passive).at("last_touch");
  const auto box = std::to_string(touch.at("box").get<int>());
  ASSERT_EQ(pair.telehug("mute", Side::passive, {box}).code, 0);
  EXPECT_TRUE(eventually([this] { return !pair.felt(); })) << pair.logs();
  EXPECT_TRUE(eventually([this] { return pair.status(Side::passive).at("last_touch").at("outcome") == "muted"; }))
      << pair.logs();
  EXPECT_EQ(consent().at("muted_boxes"), Json::array({std::stoi(box)}));
  ASSERT_EQ(pair.telehug("unmute", Side::passive, {"--all"}).code, 0);
  EXPECT_TRUE(eventually([this] { return pair.felt(); })) << pair.logs();
}

TEST_F(WearersConsent, IsPausedIfItsFileIsDamaged) {
  std::ofstream(pair.folder / "consent.json") << "{\"format\":1,\"pau";
  pair.start_jacket();
  pair.start_passive();
  ASSERT_TRUE(eventually([this] { return is("paused"); })) << pair.logs();
  EXPECT_TRUE(pair.complains(Side::passive, "consent.json is damaged")) << pair.logs();
  EXPECT_NE(pair.logs().find("`telehug unpause` begins anew"), std::string::npos) << pair.logs();
  EXPECT_EQ(pair.telehug("unpause", Side::passive).code, 0);
  EXPECT_TRUE(is("open"));
}

}  // namespace
}  // namespace telehug
