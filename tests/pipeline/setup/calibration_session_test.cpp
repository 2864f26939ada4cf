// SPDX-License-Identifier: Apache-2.0
//
// People who calibrate a rendered rig, from nothing to a saved calibration.
#include "setup/calibration_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>

#include "calibration/calibration_file.hpp"
#include "detection/make_detector.hpp"
#include "detection/touch_calibration.hpp"
#include "doubles/random_set_up.hpp"
#include "doubles/rig_with_pages.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;

bool solved(const SetupState& state) {
  return state.step == SetupStep::solved;
}

class SettingUp : public testing::Test {
 protected:
  static void SetUpTestSuite() { rig = new RigWithPages(VirtualRigSettings{}); }
  static void TearDownTestSuite() { delete rig; }

  static SessionSettings settings() {
    SessionSettings settings;
    settings.screen = rig->settings().screen;
    settings.confirm_border = false;
    settings.camera = "virtual";
    settings.date = "2026-01-01T00:00:00Z";
    return settings;
  }
  static SessionSettings quick() {
    SessionSettings two = settings();
    two.quick = true;
    return two;
  }
  // The seconds after which the first dot is shown.
  static void go_to_dots(RenderedSetUp& set_up) {
    ASSERT_TRUE(set_up.run(
        touching_person(), [](const SetupState& s) { return s.step == SetupStep::dots; }, 300));
  }
  static RigWithPages::Errors errors(const CalibrationSession& session) {
    const auto rig_found = session.calibrated();
    if (!rig_found.ok()) return {{1e9, 1e9}, {1e9, 1e9}};
    return rig->errors(std::get<RigCalibration>(rig_found->calibration.solved));
  }

  static inline RigWithPages* rig = nullptr;  // draws each picture once
};

TEST_F(SettingUp, CalibratesNineDotsInLessThanAMinuteToPartsOfAMillimetre) {
  CalibrationSession session(settings());
  RenderedSetUp set_up(*rig, session);
  ASSERT_TRUE(set_up.run(touching_person(), solved, 60 * 30)) << name_of(session.state().advice);
  EXPECT_LT(set_up.seconds(), 60);
  const SetupResult& result = *session.state().result;
  EXPECT_THAT(result.faults, IsEmpty());
  EXPECT_THAT(result.repeat, IsEmpty());
  ASSERT_EQ(result.dots.size(), 9U);
  for (const DotOutcome& dot : result.dots)
    EXPECT_TRUE(dot.used);

  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "rig.toml";
  ASSERT_TRUE(session.save(file).ok());
  EXPECT_EQ(session.state().step, SetupStep::saved);
  const auto saved = read_calibration(file);
  ASSERT_TRUE(saved.ok()) << saved.error().message;
  EXPECT_TRUE(read_background_of(file, *saved).ok());
  const auto found = rig->errors(std::get<RigCalibration>(saved->solved));
  RecordProperty("seconds", std::to_string(set_up.seconds()));
  RecordProperty("mean_horizontal_mm", std::to_string(found.mean.x_mm));
  RecordProperty("mean_vertical_mm", std::to_string(found.mean.y_mm));
  EXPECT_LT(found.mean.x_mm, 0.1);
  EXPECT_LT(found.mean.y_mm, 0.3);

  // What is predicted is of the size of what is true, where fingers are like the one that has calibrated.
  const std::size_t seen = static_cast<std::size_t>(std::count_if(
      result.errors.fields.begin(), result.errors.fields.end(), [](const auto& field) { return field.has_value(); }));
  EXPECT_GT(seen, result.errors.fields.size() / 4);
  EXPECT_LT(seen, result.errors.fields.size());
}

TEST_F(SettingUp, IsAsExactWithTwoDotsAsPicturesTakenByHand) {
  CalibrationSession session(quick());
  RenderedSetUp set_up(*rig, session);
  ASSERT_TRUE(set_up.run(touching_person(), solved, 30 * 30)) << name_of(session.state().advice);
  const auto found = errors(session);

  CalibrationPictures by_hand{rig->settings().screen,
                              rig->picture(SetupPage::black, {}, {}).clone(),
                              rig->picture(SetupPage::triangle, {}, {}).clone(),
                              rig->picture(SetupPage::marks, {}, {}).clone(),
                              {}};
  for (const ScreenPoint& dot : session.state().dots)
    by_hand.touches.push_back({rig->picture(SetupPage::dot, {dot}, pointing_at(dot)).clone(), dot});
  const auto before = calibrate_with_pictures(by_hand);
  ASSERT_TRUE(before.ok()) << before.error().message;
  const auto known = rig->errors(*before);
  RecordProperty("seconds", std::to_string(set_up.seconds()));
  RecordProperty("mean_vertical_mm", std::to_string(found.mean.y_mm));
  RecordProperty("by_hand_mean_vertical_mm", std::to_string(known.mean.y_mm));
  EXPECT_LT(found.mean.x_mm, known.mean.x_mm + 0.05);
  EXPECT_LT(found.mean.y_mm, known.mean.y_mm + 0.1);
  EXPECT_TRUE(session.state().result->good());
}

TEST_F(SettingUp, SolvesTheThesisModelFromTwoDots) {
  SessionSettings thesis = settings();
  thesis.thesis = true;
  CalibrationSession session(thesis);
  RenderedSetUp set_up(*rig, session);
  ASSERT_TRUE(set_up.run(touching_person(), solved, 30 * 30)) << name_of(session.state().advice);
  EXPECT_THAT(session.state().result->faults, IsEmpty());
  const auto found = session.calibrated();
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_STREQ(found->calibration.model_name(), "thesis");
}

TEST_F(SettingUp, DoesNotTakeAHandThatShakes) {
  CalibrationSession session(quick());
  RenderedSetUp set_up(*rig, session);
  go_to_dots(set_up);
  EXPECT_FALSE(set_up.run(
      touching_person(0, 9), [](const SetupState& s) { return s.taken > 0; }, 8 * 30));
  EXPECT_THAT(set_up.said, Contains("finger_moves"));
  EXPECT_TRUE(set_up.run(touching_person(), solved, 30 * 30)) << "but goes on when it has become still";
}

TEST_F(SettingUp, SaysHowFarAFingerIsFromItsDotAndDoesNotTakeIt) {
  CalibrationSession session(quick());
  RenderedSetUp set_up(*rig, session);
  go_to_dots(set_up);
  EXPECT_FALSE(set_up.run(
      touching_person(40), [](const SetupState& s) { return s.taken > 0; }, 10 * 30));
  EXPECT_EQ(session.state().advice, SetupAdvice::finger_beside_dot);
  ASSERT_TRUE(session.state().off_mm.has_value());
  EXPECT_NEAR(session.state().off_mm->x_mm, 40, 5);
  EXPECT_NEAR(session.state().off_mm->y_mm, 0, 8);
}

TEST_F(SettingUp, DoesNotTakeAFingerThatHovers) {
  CalibrationSession session(quick());
  RenderedSetUp set_up(*rig, session);
  go_to_dots(set_up);
  const Person hovering = [](const SetupState& state, double asked_s) -> std::optional<HandPose> {
    if (state.step != SetupStep::dots || asked_s < 1) return std::nullopt;
    return pointing_at(state.dots[state.dot], 6);
  };
  EXPECT_FALSE(set_up.run(
      hovering, [](const SetupState& s) { return s.taken > 0; }, 10 * 30));
  EXPECT_THAT(set_up.said, Contains("finger_hovers"));
}

TEST_F(SettingUp, DoesNotTakeAFingerThatPasses) {
  CalibrationSession session(quick());
  RenderedSetUp set_up(*rig, session);
  go_to_dots(set_up);
  // 30 mm/s across the dot, again and again.
  const Person passing = [](const SetupState& state, double asked_s) -> std::optional<HandPose> {
    if (state.step != SetupStep::dots || asked_s < 1) return std::nullopt;
    const ScreenPoint dot = state.dots[state.dot];
    return pointing_at({dot.x_mm - 30 + static_cast<double>(static_cast<int>(asked_s * 30) % 60), dot.y_mm});
  };
  EXPECT_FALSE(set_up.run(
      passing, [](const SetupState& s) { return s.taken > 0; }, 8 * 30));
}

TEST_F(SettingUp, WaitsForSomebodyAndEndsAfterFiveMinutes) {
  CalibrationSession session(quick());
  RenderedSetUp set_up(*rig, session);
  const Person nobody = [](const SetupState&, double) { return std::nullopt; };
  EXPECT_FALSE(set_up.run(nobody, solved, 10 * 30));
  EXPECT_EQ(session.state().step, SetupStep::dots);
  EXPECT_EQ(session.state().advice, SetupAdvice::touch_dot);
  EXPECT_EQ(session.state().taken, 0U);
  EXPECT_THAT(set_up.said, Not(Contains("hands_away")));
  set_up.pass(5min);
  set_up.step(nobody);
  EXPECT_EQ(session.state().step, SetupStep::cancelled);
  EXPECT_EQ(session.state().advice, SetupAdvice::idle);
}

TEST_F(SettingUp, TakesOneDotAgainAndSolvesAnew) {
  CalibrationSession session(quick());
  RenderedSetUp set_up(*rig, session);
  ASSERT_TRUE(set_up.run(touching_person(), solved, 30 * 30));
  const std::size_t taken = session.state().taken;
  set_up.pass(6min);  // somebody reads what was found
  ASSERT_TRUE(session.repeat(1));
  EXPECT_EQ(session.state().step, SetupStep::dots);
  EXPECT_EQ(session.state().dot, 1U);
  EXPECT_FALSE(session.calibrated().ok());
  ASSERT_TRUE(set_up.run(touching_person(), solved, 30 * 30));
  EXPECT_EQ(session.state().taken, taken + 1);
  EXPECT_TRUE(session.state().can_save);
}

class SettingUpOtherCameras : public SettingUp, public testing::WithParamInterface<std::pair<bool, bool>> {};

TEST_P(SettingUpOtherCameras, FindsOutHowTheCameraDeliversItsPictures) {
  CalibrationSession session(quick());
  RenderedSetUp set_up(*rig, session);
  set_up.upside_down = GetParam().first;
  set_up.mirrored = GetParam().second;
  ASSERT_TRUE(set_up.run(touching_person(), solved, 40 * 30)) << name_of(session.state().advice);
  EXPECT_THAT(session.state().result->faults, IsEmpty());
  const auto found = session.calibrated();
  ASSERT_TRUE(found.ok()) << found.error().message;
  const PictureOrientation seen =
      std::get<RigCalibration>(found->calibration.solved).solution.model.camera.orientation();
  EXPECT_EQ(seen.top_bottom_exchanged, set_up.upside_down);
  EXPECT_EQ(seen.left_right_exchanged, set_up.upside_down != set_up.mirrored);
}

INSTANTIATE_TEST_SUITE_P(Cameras, SettingUpOtherCameras,
                         testing::Values(std::pair{true, false}, std::pair{false, true}));

// Random rigs that were difficult once; `tests/bench/run setup` sets up as many as one likes.
class SettingUpRandomRigs : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SettingUpRandomRigs, EndsWellInLessThanAMinute) {
  const std::uint64_t seed = GetParam();
  SetUpTrial two_dots;
  two_dots.quick = true;
  const SetUpOutcome outcome = set_up_random_rig(seed, two_dots);
  EXPECT_STREQ(outcome.name(), "good") << outcome.said;
  EXPECT_EQ(outcome.lifted, 0);
  EXPECT_LT(outcome.seconds, 15);
  ASSERT_TRUE(outcome.errors.has_value());
  EXPECT_LT(outcome.errors->x_mm, 0.5);
  EXPECT_LT(outcome.errors->y_mm, 1.5);
}

// 703: a rolled camera, so that one of the triangle's edges is level. 719: a dim screen in a light bezel, no lighter
// than the desk. 800: few marks are seen. 803: marks are taken for their neighbours. 811: the exposure breathes by 12 %
// and marks are white in part of their fields.
INSTANTIATE_TEST_SUITE_P(Rigs, SettingUpRandomRigs, testing::Values(703, 719, 800, 803, 811));

TEST(SettingUpManyRandomRigs, NeverSavesAWrongCalibration) {
  if (getenv("TELEHUG_LONG_TESTS") == nullptr) GTEST_SKIP() << "takes minutes: tests/run --long runs it";
  int good = 0;
  for (std::uint64_t seed = 900; seed < 924; ++seed) {
    const SetUpOutcome outcome = set_up_random_rig(seed, {});
    EXPECT_STRNE(outcome.name(), "WRONG") << seed;
    good += outcome.end == SetUpEnd::good ? 1 : 0;
  }
  EXPECT_GE(good, 22);
}

}  // namespace
}  // namespace telehug
