// SPDX-License-Identifier: Apache-2.0
//
// `telehug jacket` with the real daemon and the real firmware in the simulator.
#include <gmock/gmock.h>

#include "integration/app/running_pair.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TheJacketCommand : public testing::Test {
 protected:
  void SetUp() override {
    pair.start_jacket();
    pair.start_passive();
    ASSERT_TRUE(eventually([&] { return pair.jacket_state() == "armed"; })) << pair.logs();
  }
  [[nodiscard]] Outcome jacket(const std::vector<std::string>& words) const {
    std::vector<std::string> command{TELEHUG_BIN "/telehug", "jacket"};
    command.insert(command.end(), words.begin(), words.end());
    command.insert(command.end(), {"--socket", pair.socket(Side::passive).string()});
    return pair.run(command);
  }
  // In the order in which they were switched on, each once for a run of pulses.
  [[nodiscard]] std::vector<int> channels_that_ran() const {
    std::vector<int> channels;
    for (const PinChange& change : pair.pins())
      if (channels.empty() || channels.back() != change.channel) channels.push_back(change.channel);
    return channels;
  }

  RunningPair pair;
};

TEST_F(TheJacketCommand, ListsTheActuatorsWithTheirPlaces) {
  const Outcome text = jacket({"list"});
  EXPECT_EQ(text.code, 0);
  EXPECT_THAT(text.text,
              AllOf(HasSubstr("Duemilanove, 16 motors"), HasSubstr("○12"), HasSubstr("left upper arm, low")));
  const Json json = Json::parse(jacket({"list", "--json"}).text);
  EXPECT_EQ(json.at("actuators").size(), 16U);
  EXPECT_TRUE(json.at("answers").get<bool>());
  EXPECT_FALSE(json.contains("svg"));
}

TEST_F(TheJacketCommand, DrawsTheBodyIntoAFile) {
  const auto file = pair.folder.path() / "body.svg";
  EXPECT_EQ(jacket({"list", "--out", file.string()}).code, 0);
  const std::string svg = content_of(file);
  EXPECT_THAT(svg, AllOf(HasSubstr("<svg xmlns="), HasSubstr(">breastbone</title>"), HasSubstr("</svg>")));
  const Outcome full = jacket({"list", "--out", "/dev/full"});
  EXPECT_EQ(full.code, to_int(ExitCode::internal));
  EXPECT_THAT(full.text, HasSubstr("/dev/full can't be written"));
}

TEST_F(TheJacketCommand, RunsOneActuatorAndNoOtherAndEnds) {
  const Outcome outcome = jacket({"test", "7", "--seconds", "0.3"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(channels_that_ran(), ElementsAre(6));
  EXPECT_TRUE(eventually([&] { return pair.running().empty(); }));
}

TEST_F(TheJacketCommand, WalksAlongAllMotorsWithTheirNames) {
  const Outcome outcome = jacket({"identify", "--seconds", "0.1"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("   1  right shoulder\n"), HasSubstr("  16  left belly\n")));
  EXPECT_THAT(channels_that_ran(), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
}

TEST_F(TheJacketCommand, IsRefusedWhileEverythingIsStopped) {
  ASSERT_EQ(pair.telehug("stop", Side::passive).code, 0);
  ASSERT_TRUE(eventually([&] { return pair.status(Side::passive).at("state") == "stopped"; }));
  const Outcome outcome = jacket({"test", "7"});
  EXPECT_EQ(outcome.code, to_int(ExitCode::refused));
  EXPECT_THAT(outcome.text, HasSubstr("`telehug resume` first"));
  EXPECT_THAT(channels_that_ran(), ElementsAre());
}

TEST_F(TheJacketCommand, SaysWhichActuatorThereIsNot) {
  const Outcome outcome = jacket({"test", "200"});
  EXPECT_EQ(outcome.code, to_int(ExitCode::refused));
  EXPECT_THAT(outcome.text, HasSubstr("has no actuator 200"));
}

}  // namespace
}  // namespace telehug
