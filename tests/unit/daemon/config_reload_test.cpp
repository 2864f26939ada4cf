// SPDX-License-Identifier: Apache-2.0
#include "daemon/config_reload.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::internal::CaptureStderr;
using testing::internal::GetCapturedStderr;

class AReload : public testing::Test {
 protected:
  AReload() { set_up_log("info", LogStyle::journal); }

  // What the log says meanwhile.
  std::string reload(const ConfigReload<PassiveConfig>::Load& load) {
    CaptureStderr();
    ConfigReload<PassiveConfig>(load).again(used, notes, [this](const PassiveConfig& next) -> Status {
      if (!obstacle.empty()) return Error{obstacle};
      used = next;
      return Done{};
    });
    return GetCapturedStderr();
  }
  std::string reload(const PassiveConfig& read) {
    return reload([&] { return read; });
  }
  [[nodiscard]] std::vector<std::string> problems() const {
    nlohmann::json list = nlohmann::json::array();
    notes.add_problems(list);
    std::vector<std::string> texts;
    for (const auto& problem : list) {
      EXPECT_THAT(problem.at("do").get<std::string>(), HasSubstr("telehug-passive"));
      texts.push_back(problem.at("what"));
    }
    return texts;
  }

  PassiveConfig used;
  std::string obstacle;
  ReloadNotes notes{Side::passive};
};

TEST_F(AReload, TakesLiveKeysOverAndSaysWhatNeedsARestartUntilItIsAsBefore) {
  PassiveConfig read = used;
  read.consent.quiet_hours = "20:00-07:00";
  read.safety.max_strength = 0.5;
  EXPECT_EQ(reload(read),
            "<4>configuration: safety.max_strength = 0.5 needs a restart; 1.0 is still in use\n"
            "<6>configuration: consent.quiet_hours is \"20:00-07:00\" now, was \"\"\n"
            "<6>configuration: read anew\n");
  EXPECT_EQ(used.consent.quiet_hours, "20:00-07:00");
  EXPECT_EQ(used.safety.max_strength, 1);
  EXPECT_THAT(problems(), ElementsAre("configuration: safety.max_strength = 0.5 needs a restart; 1.0 is still in use"));
  read.safety.max_strength = 1;
  EXPECT_EQ(reload(read), "<6>configuration: read anew, nothing has changed\n");
  EXPECT_THAT(problems(), IsEmpty());
}

TEST_F(AReload, KeepsAllAndNamesEveryFaultWithItsPlaceUntilAGoodOne) {
  used.consent.quiet_hours = "20:00-07:00";
  EXPECT_EQ(reload([] { return Result<PassiveConfig>(Error{"/a.toml:3: what\n/b.toml:7: else"}); }),
            "<3>configuration: /a.toml:3: what\n<3>configuration: /b.toml:7: else\n"
            "<3>configuration: not taken, the one before stays in use\n");
  EXPECT_EQ(used.consent.quiet_hours, "20:00-07:00");
  EXPECT_THAT(problems(), ElementsAre("configuration: /a.toml:3: what", "configuration: /b.toml:7: else"));
  reload(used);
  EXPECT_THAT(problems(), IsEmpty());
}

TEST_F(AReload, KeepsAllIfTheFilesCantBeReadOrTheDaemonCantUseThem) {
  EXPECT_THAT(reload([]() -> Result<PassiveConfig> { throw std::runtime_error("no disk"); }),
              HasSubstr("<3>configuration: no disk\n"));
  obstacle = "no such detector";
  PassiveConfig read = used;
  read.log.level = "debug";
  EXPECT_EQ(reload(read),
            "<3>configuration: no such detector\n<3>configuration: not taken, the one before stays in use\n");
  EXPECT_THAT(problems(), ElementsAre("configuration: no such detector"));
  EXPECT_EQ(spdlog::get_level(), spdlog::level::info);
}

TEST_F(AReload, ForgetsNothingThatStillWaitsForARestartBecauseOfAFault) {
  PassiveConfig read = used;
  read.web.port = 1;
  reload(read);
  reload([] { return Result<PassiveConfig>(Error{"/a.toml:3: what"}); });
  EXPECT_THAT(problems(), ElementsAre("configuration: /a.toml:3: what",
                                      "configuration: web.port = 1 needs a restart; 0 is still in use"));
}

TEST_F(AReload, FollowsTheLevelOfTheLog) {
  PassiveConfig read = used;
  read.log.level = "debug";
  reload(read);
  EXPECT_EQ(spdlog::get_level(), spdlog::level::debug);
}

}  // namespace
}  // namespace telehug
