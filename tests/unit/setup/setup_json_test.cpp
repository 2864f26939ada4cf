// SPDX-License-Identifier: Apache-2.0
#include "setup/setup_json.hpp"

#include <gtest/gtest.h>

#include <set>

namespace telehug {
namespace {

using nlohmann::json;

constexpr ScreenSize screen{380, 300, 1280, 1024};

TEST(SetupJson, OfTheBeginningTellsWhatToShowAndNothingElse) {
  const json state = setup_json({}, screen);
  EXPECT_EQ(state["step"], "bright");
  EXPECT_EQ(state["show"]["page"], "triangle");
  EXPECT_EQ(state["show"]["width_mm"], 380);
  EXPECT_EQ(state["show"]["triangle"][0], (json{190.0, 300.0}));
  EXPECT_TRUE(state["show"]["dots"].empty());
  for (const char* nothing : {"green_band", "border", "finger", "off_mm", "result"})
    EXPECT_TRUE(state[nothing].is_null()) << nothing;
  EXPECT_EQ(state["can"], (json{{"confirm", false}, {"back", false}, {"skip", false}, {"save", false}}));
}

TEST(SetupJson, OfADotShowsThatOne) {
  SetupState state;
  state.step = SetupStep::dots;
  state.page = SetupPage::dot;
  state.dots = {{80, 230}, {300, 230}};
  state.dot = 1;
  state.off_mm = {12, -3};
  state.finger_px = ImagePoint{640, 500};
  state.advice = SetupAdvice::finger_beside_dot;
  const json text = setup_json(state, screen);
  EXPECT_EQ(text["show"]["dots"], (json::array({json{300.0, 230.0}})));
  EXPECT_EQ(text["show"]["dot_mm"], 10);
  EXPECT_EQ(text["off_mm"], (json{12.0, -3.0}));
  EXPECT_EQ(text["finger"], (json{640.0, 500.0}));
  EXPECT_EQ(text["advice"], "finger_beside_dot");
}

TEST(SetupJson, OfTheMarksShowsThemAll) {
  SetupState state;
  state.page = SetupPage::marks;
  EXPECT_EQ(setup_json(state, screen)["show"]["dots"].size(), 18U);
}

TEST(SetupJson, TellsTheBorderAndTheBand) {
  SetupState state;
  state.green_band = {215, 580};
  state.border = SeenBorder{{{0, 400}, {1279, 410}}, ImagePoint{630, 405}, 0.4, true};
  const json text = setup_json(state, screen);
  EXPECT_EQ(text["green_band"]["bottom_px"], 580);
  EXPECT_EQ(text["border"]["points"][1], (json{1279.0, 410.0}));
  EXPECT_EQ(text["border"]["vertex"], (json{630.0, 405.0}));
  EXPECT_EQ(text["border"]["in_band"], true);
}

TEST(SetupJson, OfAResultHasNullWhereTheCameraSeesNothing) {
  SetupState state;
  SetupResult result;
  result.dots = {{{80, 230}, false, true, ScreenPoint{0.1, -0.2}}, {{300, 230}, true, false, std::nullopt}};
  result.repeat = {1};
  result.faults = {"too few"};
  result.errors = {2, 1, {std::nullopt, PredictedError{0.3, 0.6}}};
  result.reach.outline = {{10, 300}, {10, 150}, {370, 300}};
  state.result = result;
  const json text = setup_json(state, screen)["result"];
  EXPECT_EQ(text["good"], false);
  EXPECT_EQ(text["dots"][0]["error_mm"], (json{0.1, -0.2}));
  EXPECT_TRUE(text["dots"][1]["error_mm"].is_null());
  EXPECT_EQ(text["dots"][1]["skipped"], true);
  EXPECT_EQ(text["repeat"], json::array({1}));
  EXPECT_EQ(text["errors"]["columns"], 2);
  EXPECT_EQ(text["errors"]["vertical_mm"], (json::array({nullptr, 0.6})));
  EXPECT_EQ(text["reach"].size(), 3U);
}

TEST(SetupNames, AreAllDifferentAndHaveASentence) {
  std::set<std::string> names;
  const int last = static_cast<int>(SetupAdvice::idle);
  for (int i = 0; i <= last; ++i) {
    const auto advice = static_cast<SetupAdvice>(i);
    names.insert(name_of(advice));
    EXPECT_EQ(std::string(text_of(advice)).empty(), advice == SetupAdvice::none) << name_of(advice);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(last + 1));
}

}  // namespace
}  // namespace telehug
