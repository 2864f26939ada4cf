// SPDX-License-Identifier: Apache-2.0
#include "capture/camera_tuning.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "capture/finger_separation.hpp"
#include "capture/measure_scene.hpp"
#include "capture/webcam.hpp"
#include "doubles/fake_camera_controls.hpp"
#include "doubles/test_pictures.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;

// --- the search alone ---

class TheSearch : public ::testing::Test {
 protected:
  Result<Tuning> tune(const std::vector<CameraControl>& controls, const std::function<double()>& score,
                      const TuningOptions& options = {}) {
    const SetControl set = [this](const ControlValue& value) -> Status {
      values_[value.id] = value.value;
      return Done{};
    };
    return tune_camera(
        controls, set,
        [&]() -> std::optional<double> {
          clock_.advance(200ms);
          return score();
        },
        options, clock_);
  }

  FakeClock clock_;
  std::map<std::uint32_t, int> values_;
};

TEST_F(TheSearch, FindsTheBestOfSeveralControls) {
  const std::vector<CameraControl> controls{{1, "a", 0, 100, 1, 0, 0, false}, {2, "b", -64, 64, 2, 0, 60, false}};
  const auto tuned = tune(controls, [&] { return 1000 - std::pow(values_[1] - 72, 2) - std::pow(values_[2] + 20, 2); });
  ASSERT_TRUE(tuned);
  EXPECT_TRUE(tuned->complete);
  EXPECT_NEAR(tuned->values[0].value, 72, 5);
  EXPECT_NEAR(tuned->values[1].value, -20, 6);
  EXPECT_EQ(tuned->values[1].value % 2, 0) << "the control knows every second value";
  EXPECT_GT(tuned->after, tuned->before);
  EXPECT_EQ(values_[1], tuned->values[0].value) << "what was found is set";
  EXPECT_EQ(values_[2], tuned->values[1].value);
  EXPECT_LT(tuned->measurements, 30);
}

TEST_F(TheSearch, TellsHowMuchOfItIsDone) {
  const std::vector<CameraControl> controls{{1, "a", 0, 100, 1, 0, 0, false}, {2, "b", 0, 100, 1, 0, 0, false}};
  std::vector<double> told;
  const auto tuned = tune(controls, [] { return 1.0; }, {.progress = [&](double done) {
                            told.push_back(done);
                            return true;
                          }});
  ASSERT_TRUE(tuned);
  EXPECT_TRUE(tuned->complete);
  ASSERT_GT(told.size(), 20U);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_DOUBLE_EQ(told.front(), 0);
  EXPECT_DOUBLE_EQ(told.back(), 1);
}

TEST_F(TheSearch, EndsAtOnceWhenItIsToldTo) {
  const std::vector<CameraControl> controls{{1, "a", 0, 100, 1, 0, 50, false}};
  const auto tuned =
      tune(controls, [&] { return 1.0 * values_[1]; }, {.progress = [](double done) { return done < 0.3; }});
  ASSERT_TRUE(tuned);
  EXPECT_FALSE(tuned->complete);
  EXPECT_LT(tuned->measurements, 6);
  EXPECT_EQ(values_[1], tuned->values[0].value) << "the best so far is set";
}

TEST_F(TheSearch, EndsAlsoWhileItWaitsForACamera) {
  const std::vector<CameraControl> controls{{1, "a", 0, 100, 1, 0, 50, false}};
  int asked = 0;
  const auto tuned = tune_camera(
      controls, [](const ControlValue&) -> Status { return Done{}; },
      [&]() -> std::optional<double> {
        clock_.advance(500ms);
        return asked++ < 2 ? std::optional(1.0) : std::nullopt;
      },
      {.progress = [&](double) { return asked < 5; }}, clock_);
  EXPECT_FALSE(tuned);
  EXPECT_LT(asked, 8);
}

TEST_F(TheSearch, StepsTheExposureByFactors) {
  const std::vector<CameraControl> controls{{V4L2_CID_EXPOSURE_ABSOLUTE, "exposure", 3, 333, 1, 3, 333, false}};
  const auto tuned =
      tune(controls, [&] { return 10 - std::abs(std::log2(values_[V4L2_CID_EXPOSURE_ABSOLUTE] / 20.0)); });
  ASSERT_TRUE(tuned);
  EXPECT_NEAR(tuned->values[0].value, 20, 4);
}

TEST_F(TheSearch, LeavesAControlThatMakesNoDifference) {
  const std::vector<CameraControl> controls{{1, "a", 0, 100, 1, 0, 37, false}};
  int noise = 0;
  const auto tuned = tune(controls, [&] { return 100 + (++noise % 2); });  // 1 %
  ASSERT_TRUE(tuned);
  EXPECT_EQ(tuned->values[0].value, 37);
}

TEST_F(TheSearch, EndsInTimeWithTheBestItHadFound) {
  const std::vector<CameraControl> controls{{1, "a", 0, 100, 1, 0, 0, false}, {2, "b", 0, 100, 1, 0, 0, false}};
  const Timestamp began = clock_.now();
  const auto tuned = tune(controls, [&] { return values_[1] + values_[2]; }, {.longest = 1s});
  ASSERT_TRUE(tuned);
  EXPECT_FALSE(tuned->complete);
  EXPECT_LE(clock_.now() - began, 1200ms);
  EXPECT_GT(tuned->after, tuned->before);
  EXPECT_EQ(values_[1], tuned->values[0].value);
}

TEST(TunableControls, LimitTheExposureToAFrame) {
  const std::vector<CameraControl> controls{{V4L2_CID_EXPOSURE_ABSOLUTE, "exposure", 3, 2047, 1, 250, 250, false},
                                            {V4L2_CID_FOCUS_ABSOLUTE, "focus", 0, 255, 1, 0, 0, false},
                                            {V4L2_CID_GAIN, "gain", 5, 5, 1, 5, 5, false},
                                            {V4L2_CID_CONTRAST, "contrast", 0, 64, 1, 32, 32, false}};
  const auto tunable = tunable_controls(controls, 30);
  ASSERT_EQ(tunable.size(), 2U);
  EXPECT_EQ(tunable[0].maximum, 333);
  EXPECT_EQ(tunable[1].id, static_cast<std::uint32_t>(V4L2_CID_CONTRAST));
}

// --- with a camera whose picture depends on its settings ---

class ACameraThatIsTuned : public ::testing::Test {
 protected:
  static constexpr BorderPlace border{40, 0};

  ACameraThatIsTuned() {
    device_.controls = usual_controls();
    film_ = [this] {
      clock_.advance(33ms);
      if (--pictures_until_unplugged_ == 0) {
        device_.unplug();
        return;
      }
      device_.take(jpeg_of(scene(finger_)));
      device_.while_waiting = film_;
    };
  }

  // A dark bezel above row 40, and a finger in columns 50 to 70: their light times exposure and gain, spread by the
  // contrast; gain brings noise.
  cv::Mat scene(bool finger) {
    const double light =
        device_.control(V4L2_CID_EXPOSURE_ABSOLUTE) / 100.0 * (1 + device_.control(V4L2_CID_GAIN) / 25.0);
    const double contrast = device_.control(V4L2_CID_CONTRAST) / 32.0;
    const auto seen = [&](double level) { return (level * light - 128) * contrast + 128; };
    cv::Mat picture(72, 128, CV_8UC3, cv::Scalar(seen(30), seen(30), seen(32)));
    if (finger) picture.colRange(50, 70).setTo(cv::Scalar(seen(60), seen(75), seen(105)));
    cv::Mat noise(picture.size(), CV_16SC3);
    random_.fill(noise, cv::RNG::NORMAL, 0, 2 + device_.control(V4L2_CID_GAIN) / 8.0);
    cv::Mat noisy;
    cv::add(picture, noise, noisy, cv::noArray(), CV_8UC3);
    return noisy;
  }
  FingerSeparation separation() {
    const auto found = FingerSeparation::find(scene(false), scene(true), border);
    EXPECT_TRUE(found) << (found ? "" : found.error().message);
    return *found;
  }
  Result<Tuning> tune(const TuningOptions& options = {}) {
    const FingerSeparation objective = separation();
    EXPECT_TRUE(webcam_.open());
    EXPECT_TRUE(controls_.open("/dev/video0"));
    for (const auto& [automatic, off] : {std::pair{V4L2_CID_EXPOSURE_AUTO, 1}})
      EXPECT_TRUE(controls_.set({static_cast<std::uint32_t>(automatic), off}));
    device_.while_waiting = film_;
    return tune_camera(
        tunable_controls(controls_.list(), 30), [&](const ControlValue& value) { return controls_.set(value); },
        [&] {
          if (!device_.plugged && clock_.now() - unplugged_at() > 2s) plug_in();
          return measure_scene(webcam_, objective, frame_);
        },
        options, clock_);
  }
  Timestamp unplugged_at() {
    if (unplugged_at_ == Timestamp{}) unplugged_at_ = clock_.now();
    return unplugged_at_;
  }
  void plug_in() {
    device_.plugged = stays_away_ ? device_.plugged : true;
    for (auto& control : device_.controls) {
      if (control.id == V4L2_CID_EXPOSURE_AUTO) control.value = V4L2_EXPOSURE_MANUAL;  // as its setup would
    }
    device_.while_waiting = film_;
  }

  FakeClock clock_;
  FakeV4l2 device_{clock_};
  Webcam webcam_{{"/dev/video0", {128, 72}, 30, {}}, clock_, device_};
  CameraControls controls_{device_};
  cv::RNG random_{7};
  Frame frame_;
  bool finger_ = true;
  bool stays_away_ = false;
  int pictures_until_unplugged_ = 0;
  Timestamp unplugged_at_{};
  std::function<void()> film_;
};

TEST_F(ACameraThatIsTuned, TellsTheFingerBetterFromTheBorderAfterwards) {
  const auto tuned = tune();
  ASSERT_TRUE(tuned) << tuned.error().message;
  EXPECT_TRUE(tuned->complete);
  EXPECT_GT(tuned->after, 2 * tuned->before);
  for (const ControlValue& value : tuned->values)
    EXPECT_EQ(device_.control(value.id), value.value);
  EXPECT_LE(device_.control(V4L2_CID_GAIN), 20) << "gain is noise";
}

TEST_F(ACameraThatIsTuned, IsTunedOnWhenItWasUnpluggedMeanwhile) {
  pictures_until_unplugged_ = 60;
  const auto tuned = tune({.longest = 120s});
  ASSERT_TRUE(tuned) << tuned.error().message;
  EXPECT_NE(unplugged_at_, Timestamp{}) << "it was not unplugged";
  EXPECT_TRUE(tuned->complete);
  EXPECT_GT(tuned->after, 2 * tuned->before);
  for (const ControlValue& value : tuned->values)
    EXPECT_EQ(device_.control(value.id), value.value);
}

TEST_F(ACameraThatIsTuned, IsGivenUpInTimeWhenItStaysAway) {
  pictures_until_unplugged_ = 60;
  stays_away_ = true;
  const Timestamp began = clock_.now();
  const auto tuned = tune({.longest = 20s});
  ASSERT_FALSE(tuned);
  EXPECT_THAT(tuned.error().message, HasSubstr("no picture"));
  EXPECT_LE(clock_.now() - began, 21s);
}

// --- what is maximised ---

TEST_F(ACameraThatIsTuned, ShowsWhereTheFingerLies) {
  const FingerSeparation found = separation();
  EXPECT_NEAR(found.left_px(), 50, 1);
  EXPECT_NEAR(found.right_px(), 70, 1);
}

TEST_F(ACameraThatIsTuned, NeedsAFingerAcrossTheBorder) {
  const auto nobody = FingerSeparation::find(scene(false), scene(false), border);
  ASSERT_FALSE(nobody);
  EXPECT_THAT(nobody.error().message, HasSubstr("lay one finger"));
  EXPECT_FALSE(FingerSeparation::find(scene(false), scene(true), {400, 0}));
  EXPECT_FALSE(FingerSeparation::find(scene(false), cv::Mat(), border));
}

TEST_F(ACameraThatIsTuned, IsNotFooledByAPictureThatGotBrighterAsAWhole) {
  cv::Mat brighter;
  cv::add(scene(true), cv::Scalar::all(30), brighter);
  const auto found = FingerSeparation::find(scene(false), brighter, border);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->left_px(), 50, 1);
}

TEST_F(ACameraThatIsTuned, ScoresColourApartHighNoiseAndBlownOutPicturesLow) {
  const FingerSeparation score = separation();
  const double usual = score(scene(true));
  EXPECT_GT(usual, 1);
  EXPECT_LT(score(scene(false)), 0.2);
  const auto gain = std::ranges::find(device_.controls, V4L2_CID_GAIN, &FakeV4l2::Control::id);
  gain->value = 100;
  EXPECT_LT(score(scene(true)), usual);
  EXPECT_EQ(score(cv::Mat(72, 128, CV_8UC3, cv::Scalar::all(255))), 0);
  EXPECT_EQ(score(cv::Mat(10, 10, CV_8UC3, cv::Scalar::all(5))), 0);
}

}  // namespace
}  // namespace telehug
