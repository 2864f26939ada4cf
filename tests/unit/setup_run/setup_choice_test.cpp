// SPDX-License-Identifier: Apache-2.0
#include "setup_run/setup_choice.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace telehug {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

TEST(AChoice, IsReadFromARequestAndKeepsWhatIsNotThere) {
  SetupChoice choice{"webcam:/dev/video0", {400, 300, 0, 0}, "DP-1", SetupMode::full};
  ASSERT_TRUE(read_choice(
      {{"width_mm", 597.5}, {"height_mm", 336}, {"width_px", 2560}, {"height_px", 1440}, {"mode", "quick"}}, choice));
  EXPECT_EQ(choice.screen.width_mm, 597.5);
  EXPECT_EQ(choice.screen.height_mm, 336);
  EXPECT_EQ(choice.screen.width_px, 2560);
  EXPECT_EQ(choice.screen.height_px, 1440);
  EXPECT_EQ(choice.mode, SetupMode::quick);
  EXPECT_EQ(choice.monitor, "DP-1");
  EXPECT_EQ(choice.camera, "webcam:/dev/video0");
}

TEST(AChoice, IsNotChangedByARequestWithAFault) {
  const std::vector<std::pair<Json, const char*>> faulty{
      {{{"width_mm", 99}}, "width_mm"},
      {{{"width_mm", 3001}}, "width_mm"},
      {{{"height_mm", "300"}}, "height_mm"},
      {{{"height_mm", std::numeric_limits<double>::quiet_NaN()}}, "height_mm"},
      {{{"width_px", -1}}, "width_px"},
      {{{"height_px", 1e9}}, "height_px"},
      {{{"monitor", 7}}, "monitor"},
      {{{"monitor", "a\nb"}}, "monitor"},
      {{{"monitor", std::string(65, 'x')}}, "monitor"},
      {{{"mode", "nine"}}, "mode"},
      {{{"mode", nullptr}}, "mode"},
  };
  for (auto [request, key] : faulty) {
    SetupChoice choice{"camera", {400, 300, 10, 20}, "DP-1", SetupMode::thesis};
    request["width_px"] = request.value("width_px", Json(55));
    const Status read = read_choice(request, choice);
    ASSERT_FALSE(read) << request;
    EXPECT_THAT(read.error().message, HasSubstr(key));
    EXPECT_EQ(choice.screen.width_mm, 400);
    EXPECT_EQ(choice.screen.width_px, 10);
    EXPECT_EQ(choice.monitor, "DP-1");
    EXPECT_EQ(choice.mode, SetupMode::thesis);
  }
}

}  // namespace
}  // namespace telehug
