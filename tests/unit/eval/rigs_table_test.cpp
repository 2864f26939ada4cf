// SPDX-License-Identifier: Apache-2.0
#include "eval/rigs_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "doubles/temporary_folder.hpp"
#include "eval/rigs_csv.hpp"

namespace telehug {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

RigOutcome rig_with(std::uint64_t seed, const std::string& coat, const TouchScore& score) {
  RigOutcome rig;
  rig.seed = seed;
  rig.screen = {400, 300, 1280, 1024};
  rig.coat = coat;
  rig.groups = {"coat " + coat};
  rig.algorithms = {{"", score, {}, {}}};
  return rig;
}

TouchScore touches_off_by(double vertical_mm, int count) {
  TouchScore score;
  for (int i = 0; i < count; ++i)
    score.touches.push_back({"frames/001", "II", "chat", true, vertical_mm, 1, {100, 200}, "touch"});
  return score;
}

class RigsTable : public testing::Test {
 protected:
  RigsTable() {
    options_.count = 3;
    TouchScore glossy = touches_off_by(3, 150);
    glossy.rests.push_back({"frames/002", "II", "chat", "hover", {{1, 1}}, 20.0, "hover"});
    glossy.extras = {{"frames/001", {5, 6}}, {"frames/001", {7, 8}}};
    RigOutcome failed;
    failed.seed = 3;
    failed.algorithms = {{"triangle.jpg: no border", {}, {}, {}}};
    outcomes_ = {rig_with(1, "glossy", glossy), rig_with(2, "matt", touches_off_by(1, 350)), failed};
  }
  EvalRigsOptions options_;
  std::vector<RigOutcome> outcomes_;
};

TEST_F(RigsTable, MarksGroupsThatAreMuchWorseThanAll) {
  const std::string table = format_rigs_table(options_, outcomes_, 0);
  EXPECT_THAT(table, ContainsRegex("coat glossy +150 .* 1.88 +1.00 +1.88 +1.00 !\n"));
  EXPECT_THAT(table, ContainsRegex("coat matt +350 .* 0.62 +1.00 +0.62 +1.00\n"));
}

TEST_F(RigsTable, MarksNoGroupOfAFewTouches) {
  outcomes_[0].algorithms[0].score.touches.resize(99);
  EXPECT_FALSE(error_ratio(summarise(outcomes_, 0).groups.at("coat glossy"), summarise(outcomes_, 0).all).stands_out);
}

TEST_F(RigsTable, TellsFalseTouchesAndWhatWasFoundBesideRealOnes) {
  const std::string table = format_rigs_table(options_, outcomes_, 0);
  EXPECT_THAT(table, ContainsRegex("hover >= 10 mm, glossy +1 of +1\n"));
  EXPECT_THAT(table, HasSubstr("beside real ones: 2 in 1 frames"));
}

TEST_F(RigsTable, SaysWhichRigsWereNotCalibratedAndWhy) {
  const std::string table = format_rigs_table(options_, outcomes_, 0);
  EXPECT_THAT(table, HasSubstr("1 of 3 rigs not calibrated"));
  EXPECT_THAT(table, HasSubstr("virtual:3 was not calibrated: triangle.jpg: no border"));
}

TEST_F(RigsTable, BecomesACsvForOwnAnalyses) {
  outcomes_[1].algorithms[0].score.touches.resize(1);
  outcomes_.erase(outcomes_.begin());
  const TemporaryFolder folder;
  ASSERT_TRUE(write_rigs_csv(folder / "rigs.csv", options_, outcomes_).ok());
  std::stringstream text;
  text << std::ifstream(folder / "rigs.csv").rdbuf();
  EXPECT_EQ(text.str(),
            "seed,detector,model,groups,what,frame,tone,screen,notes,hover_mm,x_mm,y_mm,found_x_mm,found_y_mm\n"
            "2,default,default,coat matt,touch,frames/001,II,chat,touch,,100.00,200.00,101.00,201.00\n"
            "3,default,default,,failed,,,,,,,,,\n");
}

}  // namespace
}  // namespace telehug
