// SPDX-License-Identifier: Apache-2.0
#include "eval/touch_score.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doubles/aligned_rig.hpp"
#include "eval/error_table.hpp"

namespace telehug {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

TruthRow touch(const std::string& frame, double x_mm, double y_mm) {
  return {frame, true, ScreenPoint{x_mm, y_mm}, std::nullopt, "left", "II", "chat2", "touch polish"};
}

TruthRow rest(const std::string& frame, const std::string& notes) {
  return {frame, false, std::nullopt, std::nullopt, "", "", "black", notes};
}

TEST(TouchScore, PairsEachTouchWithTheNearestPoint) {
  const TouchScore score =
      score_touches({{"1", {{200, 100}, {101, 98}}}}, {touch("1", 100, 100), touch("1", 204, 100)});
  ASSERT_EQ(score.touches.size(), 2U);
  EXPECT_TRUE(score.touches[0].found);
  EXPECT_DOUBLE_EQ(score.touches[0].horizontal_error_mm, 1);
  EXPECT_DOUBLE_EQ(score.touches[0].vertical_error_mm, -2);
  EXPECT_DOUBLE_EQ(score.touches[1].horizontal_error_mm, -4);
  EXPECT_EQ(score.touches[0].screen, "chat");
  EXPECT_EQ(score.extras.size(), 0U);
}

TEST(TouchScore, CountsMissedAndExtraTouches) {
  const TouchScore score = score_touches({{"1", {}}, {"2", {{5, 5}, {300, 5}}}}, {touch("1", 1, 1), touch("2", 5, 5)});
  ASSERT_EQ(score.touches.size(), 2U);
  EXPECT_FALSE(score.touches[0].found);
  EXPECT_TRUE(score.touches[1].found);
  EXPECT_EQ(score.extras.size(), 1U);
}

TEST(TouchScore, CountsFalseTouchesByTheKindOfFrame) {
  const TouchScore score =
      score_touches({{"1", {{1, 1}}}, {"2", {}}, {"3", {{2, 2}}}}, {rest("1", "hover polish"), rest("2", "nohand")});
  ASSERT_EQ(score.rests.size(), 2U);  // nothing is known of frame 3
  EXPECT_EQ(score.rests[0].kind, "hover");
  EXPECT_EQ(score.rests[0].false_touches.size(), 1U);
  EXPECT_EQ(score.rests[1].false_touches.size(), 0U);
}

class ErrorTable : public testing::Test {
 protected:
  static EvalTouchReport report(std::optional<TouchScore> score) {
    const AlignedRig rig{{380, 300, 1280, 1024}, 187, 12, 950.0 * 40, -950};
    const MeasuredTouch first = rig.project({190, 100});
    const MeasuredTouch second = rig.project({220, 220});
    EvalTouchOptions options;
    options.rig = "recordings/desk";
    options.algorithm = thesis_algorithm;
    return {options,
            {"",
             "",
             {1280, 720},
             rig.screen,
             {500, 0},
             ThesisCalibration{{first, second}, ThesisTouchModel::solve(rig.screen, first, second).value()}},
            {{{"1", {}}}, {}, {{7, "008", "018"}, {8, "020", ""}}, 0},
            std::move(score),
            {}};
  }
};

TEST_F(ErrorTable, ShowsFailuresErrorsAndFalseTouches) {
  TouchScore score;
  score.touches = {{"1", "II", "chat", true, -2, 1},
                   {"2", "II", "chat", true, 4, 3},
                   {"3", "V", "black", true, 30, 0},
                   {"4", "V", "black", false, 0, 0}};
  score.rests = {{"5", "V", "black", "hover", {{1, 1}}}, {"6", "", "black", "nohand"}};
  const std::string table = format_error_table(report(score));
  EXPECT_THAT(table, HasSubstr("detector thesis, model thesis"));
  EXPECT_THAT(table,
              ContainsRegex("all +4 +1 +1 +2 +3.0 \\(4.0\\) +2.0 \\(3.0\\) +12.0 \\(30.0\\) +1.3 \\(3.0\\) +1/2"));
  EXPECT_THAT(table, ContainsRegex("tone V +2 +1 +1 +0 +- +- .*1/1"));
  EXPECT_THAT(table, ContainsRegex("screen chat +2 +0 +0 +2"));
  EXPECT_THAT(table, HasSubstr("hover 1 of 1 frames, nohand 0 of 1 frames"));
  EXPECT_THAT(table, HasSubstr("contact 7: from frame 008 until frame 018\ncontact 8: from frame 020 on\n"));
}

TEST_F(ErrorTable, SaysThatThereIsNoTruth) {
  EXPECT_THAT(format_error_table(report(std::nullopt)), HasSubstr("no truth.csv"));
}

}  // namespace
}  // namespace telehug
