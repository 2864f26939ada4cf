// SPDX-License-Identifier: Apache-2.0
//
// `telehug-active look`: a line of JSON a look, for programs and for a person who wants to know what is seen.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "integration/app/running_pair.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class Look : public testing::Test {
 protected:
  std::vector<Json> looks(const std::vector<std::string>& settings) const {
    std::vector<std::string> words{TELEHUG_BIN "/telehug-active", "look", "--config", "/dev/null", "--seconds", "0.4"};
    for (const std::string& setting : settings)
      words.insert(words.end(), {"--set", setting});
    const Outcome outcome = pair.run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    std::vector<Json> lines;
    std::istringstream text(outcome.text);
    for (std::string line; std::getline(text, line);)
      lines.push_back(Json::parse(line));
    return lines;
  }

  RunningPair pair;
};

TEST_F(Look, TellsWhereFaceAndGridAreInPixelsOfTheMonitor) {
  const auto lines = looks({"body_map.picture=" TELEHUG_FIXTURES "/chat/02_self.jpg", "body_map.rate_hz=20"});
  ASSERT_GE(lines.size(), 2U);
  const Json& look = lines.back();
  EXPECT_EQ(look.at("problem"), "");
  EXPECT_EQ(look.at("monitor").at("width_px"), 1280);
  EXPECT_EQ(look.at("version"), 1);
  EXPECT_EQ(look.at("columns"), 5);
  // labels.csv: 478,193 143x229
  const Json& face = look.at("face");
  EXPECT_NEAR(face.at("x").get<double>() + face.at("w").get<double>() / 2, 478 + 143 / 2.0, 12);
  EXPECT_NEAR(face.at("y").get<double>() + face.at("h").get<double>(), 193 + 229, 14);
  EXPECT_NEAR(look.at("box_px").get<double>(), 229 / 2.0, 10);
  const Json& grid = look.at("grid");
  EXPECT_NEAR(grid.at("w").get<double>(), 5 * look.at("box_px").get<double>(), 1e-6);
  EXPECT_NEAR(grid.at("y").get<double>() + grid.at("h").get<double>(), 1024, 1e-6) << "down to the picture's bottom";
  EXPECT_LE(look.at("time_ns").get<std::int64_t>(), look.at("seen_ns").get<std::int64_t>());
}

TEST_F(Look, EndsTheGridWithTheRegion) {
  const auto lines =
      looks({"body_map.picture=" TELEHUG_FIXTURES "/chat/02_self.jpg", "body_map.region=153,102,793,675"});
  ASSERT_FALSE(lines.empty());
  const Json& grid = lines.back().at("grid");
  EXPECT_NEAR(grid.at("y").get<double>() + grid.at("h").get<double>(), 102 + 675, 1e-6);
}

TEST_F(Look, GoesOnAndSaysWhyNothingIsSeen) {
  const auto lines = looks({"body_map.picture=" + (pair.folder / "absent.jpg").string(), "body_map.rate_hz=20"});
  ASSERT_GE(lines.size(), 2U);
  for (const Json& look : lines) {
    EXPECT_EQ(look.at("version"), 0);
    EXPECT_FALSE(look.contains("grid"));
    EXPECT_THAT(look.at("problem").get<std::string>(), HasSubstr("absent.jpg"));
  }
}

}  // namespace
}  // namespace telehug
