// SPDX-License-Identifier: Apache-2.0
//
// A heater from `telehug jacket test` to the pad that warms, with the real daemon and the real firmware in the
// simulator; and what ends it.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "integration/app/running_pair.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

constexpr double longest_ms = 300;
constexpr int right_flank = 21;       // id in the shipped profile
constexpr int right_flanks_pin = 16;  // heater 0 in the simulator's log

class Heaters : public testing::Test {
 protected:
  Heaters() {
    pair.jacket_options = {"--board", "motors12_heaters2"};
    pair.passive_settings = {"jacket.profile=" TELEHUG_SOURCE "/deploy/jackets/duemilanove-12-heaters-2.toml"};
  }
  void SetUp() override {
    pair.start_jacket();
    pair.start_passive();
    ASSERT_TRUE(eventually([&] { return heater().value("state", "") == "ready" && heater().contains("celsius"); }))
        << pair.logs();
  }

  // What status tells of the right flank's heater.
  [[nodiscard]] Json heater() const {
    const Json answer = pair.status(Side::passive);
    const Json heaters = answer.is_object() ? answer.value("heaters", Json::array()) : Json::array();
    for (const Json& one : heaters)
      if (one.at("id") == right_flank) return one;
    return Json::object();
  }
  [[nodiscard]] double celsius() const { return heater().value("celsius", 0.0); }

  // `telehug jacket test` of the heater, beside the test.
  [[nodiscard]] std::unique_ptr<ChildProcess> try_heater(const char* seconds) const {
    return std::make_unique<ChildProcess>(
        std::vector<std::string>{TELEHUG_BIN "/telehug", "jacket", "test", std::to_string(right_flank), "--seconds",
                                 seconds, "--socket", pair.socket(Side::passive).string()},
        pair.folder / "trial.log");
  }
  // Nothing but this heater has ever been switched on.
  void expect_no_other_pin() const {
    for (const PinChange& change : pair.pins())
      EXPECT_EQ(change.channel, right_flanks_pin);
  }

  RunningPair pair;
};

TEST_F(Heaters, WarmTheirPadUntilAPauseEndsIt) {
  const double before = celsius();
  const auto trial = try_heater("4");
  ASSERT_TRUE(eventually([&] { return celsius() >= before + 0.3; }, 4s)) << before << " C" << pair.logs();
  EXPECT_FALSE(heater().contains("why"));
  EXPECT_EQ(pair.status(Side::passive).at("jacket").at("running"), Json::array({right_flank})) << "so the light tells";
  EXPECT_NEAR(heater().at("set_point_celsius").get<double>(), 32 + 0.7 * 7, 0.1);
  const auto silence_ms = pair.ms_to_silence([this] { ASSERT_EQ(pair.telehug("pause", Side::passive).code, 0); });
  ASSERT_TRUE(silence_ms) << pair.logs();
  fmt::print("the heater is off after `telehug pause`: {:.0f} ms\n", *silence_ms);
  EXPECT_LE(*silence_ms, longest_ms) << pair.logs();
  EXPECT_TRUE(eventually([&] { return heater().value("why", "") == "paused until further notice"; })) << pair.logs();
  EXPECT_THAT(pair.telehug("status", Side::passive).text,
              ContainsRegex("heater +right flank, warm: 3[0-9.]+ C, off: paused until further notice\n"));
  ASSERT_TRUE(eventually([&] { return !trial->runs(); }));
  EXPECT_EQ(trial->end(), to_int(ExitCode::refused));
  EXPECT_THAT(content_of(pair.folder / "trial.log"), HasSubstr("actuator 21 was not driven: paused"));
  expect_no_other_pin();
}

TEST_F(Heaters, AreOffWhenTheDaemonIsKilled) {
  const auto trial = try_heater("5");
  ASSERT_TRUE(eventually([&] { return pair.felt(); }, 4s)) << pair.logs();
  const auto silence_ms = pair.ms_to_silence([this] { pair.passive->kill_now(); });
  ASSERT_TRUE(silence_ms) << pair.logs();
  fmt::print("the heater is off after SIGKILL of telehug-passive: {:.0f} ms\n", *silence_ms);
  EXPECT_LE(*silence_ms, longest_ms) << pair.logs();
  expect_no_other_pin();
}

}  // namespace
}  // namespace telehug
