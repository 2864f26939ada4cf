// SPDX-License-Identifier: Apache-2.0
#include "eval/error_group.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/rig_groups.hpp"

namespace telehug {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Key;
using testing::Not;

ScoredTouch touch(const std::string& tone, double vertical_mm, const std::string& notes) {
  return {"1", tone, "chat", true, vertical_mm, 0, {100, 100}, notes};
}

TEST(ErrorGroups, AreReadFromTheTruthsNotes) {
  EXPECT_THAT(groups_of(touch("II", 1, "touch")),
              ElementsAre("tone II", "screen chat", "nail short", "polish no", "ring no", "glove no", "hands one"));
  EXPECT_THAT(groups_of(touch("VI", 1, "hard polish long nail ring glove two hands")),
              ElementsAre("tone VI", "screen chat", "nail long", "polish yes", "ring yes", "glove yes", "hands two"));
  EXPECT_THAT(groups_of(touch("", 1, "hard two fingers")), Contains("hands two fingers"));
}

TEST(ErrorGroups, CountFarTouchesAmongTheFoundOnesOnly) {
  ErrorGroups groups;
  add(groups, {{touch("II", -2, "touch"), touch("II", 30, "touch")}, {{"2", "II", "chat", "hover", {{1, 1}}}}, {}},
      {"coat matt"});
  for (const char* const name : {"tone II", "coat matt"}) {
    const ErrorGroup& group = groups.at(name);
    EXPECT_EQ(group.touches, 2U);
    EXPECT_EQ(group.far(), 1U);
    EXPECT_THAT(group.vertical_mm, ElementsAre(2));
    EXPECT_THAT(group.all_vertical_mm, ElementsAre(2, 30));
    EXPECT_EQ(group.rests_touched, 1U) << name;
  }
}

TEST(ErrorGroups, ThatStandAloneOfTheirKindAreLeftOut) {
  ErrorGroups groups;
  add(groups, {{touch("II", 1, "touch"), touch("V", 1, "touch ring")}, {}, {}});
  const ErrorGroups differing = groups_that_differ(groups);
  EXPECT_THAT(differing, Contains(Key("tone II")));
  EXPECT_THAT(differing, Contains(Key("ring yes")));
  EXPECT_THAT(differing, Not(Contains(Key("screen chat"))));
}

TEST(RigGroups, NameWhatWasDrawn) {
  RandomRig rig = random_rig(1);
  rig.group = {"white", "dim", "satin", "stone"};
  rig.settings.camera.pitch_deg = 3;
  rig.settings.camera.yaw_deg = 0;
  rig.settings.camera.roll_deg = -4;
  rig.settings.distortion_k1 = -0.05;
  EXPECT_THAT(groups_of(rig),
              ElementsAre("bezel white", "light dim", "coat satin", "desk stone", "camera 2.5-5 deg", "k1 < -0.03"));
}

TEST(RigGroups, TellFalseTouchesApartByWhatIsHardAboutThem) {
  const auto rest = [](const char* kind, std::optional<double> hover_mm) {
    return ScoredRest{"1", "", "", kind, {}, hover_mm};
  };
  EXPECT_EQ(rest_group(rest("nohand", std::nullopt), "matt"), "no hand");
  EXPECT_EQ(rest_group(rest("away", 100), "matt"), "away");
  EXPECT_EQ(rest_group(rest("hover", 9.9), "matt"), "hover < 10 mm");
  EXPECT_EQ(rest_group(rest("hover", 10), "glossy"), "hover >= 10 mm, glossy");
  ScoredRest mirrored = rest("hover", 10);
  mirrored.notes = "hover polish mirrored";
  EXPECT_EQ(rest_group(mirrored, "satin"), "hover >= 10 mm, satin, mirrored");
}

}  // namespace
}  // namespace telehug
