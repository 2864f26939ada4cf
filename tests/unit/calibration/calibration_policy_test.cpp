// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibration_policy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doubles/random_rig.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class CalibrationPolicy : public testing::Test {
 protected:
  static std::vector<ScreenPoint> dots_of(const RigObservations& seen) {
    std::vector<ScreenPoint> dots;
    for (const PointObservation& touch : seen.touches)
      dots.push_back(touch.screen);
    return dots;
  }
  CalibrationVerdict judged() const { return judge_calibration({seen, solve_rig(seen).value()}, dots_of(seen)); }

  RandomRigs random{31};
  KnownRig rig{{380, 300, 0, 0}, {RigCamera({1000, 0.03, {195, -15, 50}, 1, -1, 2}, {1280, 720}), 12}};
  RigObservations seen = random.observe(rig, 9, 0.3, 0.3);
};

TEST_F(CalibrationPolicy, LetsAGoodOnePass) {
  const auto verdict = judged();
  EXPECT_TRUE(verdict.good()) << verdict.faults.front();
  EXPECT_FALSE(verdict.repeat.has_value());
  EXPECT_THAT(verdict.advice, IsEmpty());
}

TEST_F(CalibrationPolicy, NamesTheTouchThatWasAtAnotherDot) {
  seen.touches[2].image = rig.tip(seen.touches[5].screen);
  const auto verdict = judged();
  EXPECT_EQ(verdict.repeat, 2U);
  EXPECT_EQ(verdict.looks_like, 5U);
  EXPECT_THAT(verdict.advice, ElementsAre(HasSubstr("touch 3 looks as if it were at dot 6")));
  EXPECT_TRUE(verdict.good()) << "eight touches are enough";
}

TEST_F(CalibrationPolicy, NamesTheTouchThatWasBesideItsDot) {
  seen.touches[4].image.v_px += 20;
  const auto verdict = judged();
  EXPECT_EQ(verdict.repeat, 4U);
  EXPECT_FALSE(verdict.looks_like.has_value());
  EXPECT_THAT(verdict.advice, ElementsAre(HasSubstr("touch dot 5 again")));
}

TEST_F(CalibrationPolicy, NamesTwoTouchesInTheWrongOrder) {
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{2, 3}, {0, 1}, {5, 7}}) {
    seen = random.observe(rig, 9, 0.3, 0.3);
    std::swap(seen.touches[a].image, seen.touches[b].image);
    const auto verdict = judged();
    ASSERT_TRUE(verdict.exchanged.has_value()) << a;
    EXPECT_EQ(*verdict.exchanged, (std::pair{a, b}));
  }
}

TEST_F(CalibrationPolicy, RefusesTouchesThatContradictEachOther) {
  for (PointObservation& touch : seen.touches) {
    touch.image.u_px += random.normal(40);
    touch.image.v_px += random.normal(15);
  }
  const auto verdict = judged();
  ASSERT_FALSE(verdict.good());
  EXPECT_THAT(verdict.faults.front(), HasSubstr("contradict each other"));
}

TEST_F(CalibrationPolicy, RefusesWhatIsTooInexact) {
  seen = random.observe(rig, 2, 0.3, 0.3, false);
  for (PointObservation& touch : seen.touches)
    touch.sigma_u_px = touch.sigma_v_px = 8;
  const auto verdict = judged();
  ASSERT_FALSE(verdict.good());
  EXPECT_THAT(verdict.faults.back(), HasSubstr("touch more dots"));
}

TEST_F(CalibrationPolicy, RefusesAnImpossibleCamera) {
  // The touches of a screen of half the size.
  const KnownRig small{{190, 150, 0, 0}, {RigCamera({1000, 0, {95, -15, 20}}, {1280, 720}), 12}};
  seen = random.observe(small, 9, 0.05, 0.05);
  seen.screen = {760, 600, 0, 0};
  for (PointObservation& touch : seen.touches)
    touch.screen = {4 * touch.screen.x_mm, 4 * touch.screen.y_mm};
  const auto verdict = judged();
  ASSERT_FALSE(verdict.good());
  EXPECT_THAT(verdict.faults, testing::Contains(HasSubstr("no webcam on top of a monitor has")));
}

}  // namespace
}  // namespace telehug
