// SPDX-License-Identifier: Apache-2.0
#include "calibration/drift_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "doubles/allocation_counter.hpp"
#include "doubles/drawn_bezel.hpp"
#include "doubles/random_rig.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

constexpr ScreenSize screen{380, 300, 0, 0};
const RigCameraParameters usual{1000, 0.03, {195, -15, 50}, 1, -1, 2};

RigCamera camera(const std::function<void(RigCameraParameters&)>& moved = {}, PictureOrientation orientation = {}) {
  RigCameraParameters parameters = usual;
  if (moved) moved(parameters);
  return {parameters, {1280, 720}, orientation};
}

TEST(BorderMeasurer, MeasuresAShiftToATenthOfARow) {
  for (const PictureOrientation orientation : {PictureOrientation{}, {true, true}}) {
    BorderMeasurer measurer(camera({}, orientation), screen);
    ASSERT_TRUE(measurer.learn(drawn_bezel(camera({}, orientation), screen)));
    const RigCamera moved = camera([](RigCameraParameters& p) { p.pitch_deg += 0.1, p.roll_deg -= 0.1; }, orientation);
    const BorderShifts& shifts = measurer.measure(drawn_bezel(moved, screen, 7, 0.8));
    ASSERT_GE(shifts.size(), border_columns - 2);
    for (const BorderShift& shift : shifts) {
      const double expected = *border_row(moved, screen.height_mm, shift.u_px) -
                              *border_row(camera({}, orientation), screen.height_mm, shift.u_px);
      EXPECT_NEAR(shift.shift_px, expected, 0.1) << "column " << shift.u_px;
    }
  }
}

TEST(BorderMeasurer, LeavesOutTheColumnsOfAFinger) {
  BorderMeasurer measurer(camera(), screen);
  ASSERT_TRUE(measurer.learn(drawn_bezel(camera(), screen)));
  cv::Mat picture = drawn_bezel(camera(), screen, 1);
  // Shaded and folded like skin: a profile of its own in every column.
  cv::RNG random(3);
  for (int v = 0; v < 640; ++v) {
    for (int u = 600; u < 730; ++u)
      picture.at<cv::Vec3b>(v, u) =
          cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(140 + 30 * std::sin(0.4 * v + u / 7) + random.gaussian(3)));
  }
  const BorderShifts& shifts = measurer.measure(picture);
  EXPECT_GE(shifts.size(), border_columns - 5);
  for (const BorderShift& shift : shifts) {
    EXPECT_FALSE(shift.u_px > 600 && shift.u_px < 730);
    EXPECT_NEAR(shift.shift_px, 0, 0.1);
  }
}

TEST(BorderMeasurer, LearnsNothingFromAnEmptyPicture) {
  BorderMeasurer measurer(camera(), screen);
  EXPECT_FALSE(measurer.learn(cv::Mat(720, 1280, CV_8UC3, cv::Scalar::all(90))));
  EXPECT_FALSE(measurer.learn(cv::Mat(480, 640, CV_8UC3)));
  EXPECT_TRUE(measurer.measure(drawn_bezel(camera(), screen)).empty()) << "nothing was learnt";
}

TEST(BorderMeasurer, WantsABorderInThePicture) {
  EXPECT_THROW(BorderMeasurer(camera([](RigCameraParameters& p) { p.pitch_deg = 40; }), screen), std::invalid_argument);
}

TEST(BorderMeasurer, AllocatesNothingAndNeitherDoesTheWatch) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has its own heap";
  BorderMeasurer measurer(camera(), screen);
  DriftWatch watch(camera(), screen);
  const cv::Mat picture = drawn_bezel(camera(), screen);
  ASSERT_TRUE(measurer.learn(picture));
  const auto before = allocation_count();
  watch.update(measurer.measure(picture), Timestamp{});
  EXPECT_EQ(allocation_count(), before);
}

class Watch : public testing::Test {
 protected:
  // Every tenth second for some time.
  const Drift& see(const BorderShifts& shifts, Duration time) {
    const Drift* drift = nullptr;
    for (const Timestamp end = now + time; now <= end; now += 100ms)
      drift = &watch.update(shifts, now);
    return *drift;
  }
  // What a camera that has moved sees, in all columns or those right of some.
  static BorderShifts shifts_of(const RigCamera& moved, double from_u_px = 0) {
    BorderShifts shifts;
    for (std::size_t i = 0; i < border_columns; ++i) {
      const double u = (static_cast<double>(i) + 0.5) / border_columns * 1280;
      if (u < from_u_px) continue;
      shifts.push_back({u, *border_row(moved, screen.height_mm, u) - *border_row(camera(), screen.height_mm, u)});
    }
    return shifts;
  }
  static BorderShifts pitched(double deg) {
    return shifts_of(camera([deg](RigCameraParameters& p) { p.pitch_deg += deg; }));
  }

  DriftWatch watch{camera(), screen};
  Timestamp now{};
};

constexpr double one_row_deg = 180 / 3.14159 / 1000;

TEST_F(Watch, IsSteadyWhileTheBorderStays) {
  EXPECT_EQ(see(pitched(0), 5s).state, DriftState::steady);
  EXPECT_EQ(see(pitched(0.4 * one_row_deg), 5s).state, DriftState::steady);
  EXPECT_STREQ(drift_text(DriftState::steady), "");
}

TEST_F(Watch, CorrectsASmallTurn) {
  const RigCamera moved = camera([](RigCameraParameters& p) { p.pitch_deg += 0.08, p.roll_deg += 0.05; });
  const Drift& drift = see(shifts_of(moved), 3s);
  EXPECT_EQ(drift.state, DriftState::moved_slightly);
  EXPECT_NEAR(drift.pitch_deg, 0.08, 0.01);
  EXPECT_NEAR(drift.roll_deg, 0.05, 0.01);
  const ScreenPoint touch{120, 220};
  const ImagePoint seen = moved.project(touch).value();
  const ScreenPoint before = camera().screen_point(seen).value();
  const ScreenPoint after = watch.corrected_camera().screen_point(seen).value();
  EXPECT_GT(std::hypot(before.x_mm - 120, before.y_mm - 220), 0.8);
  EXPECT_LT(std::hypot(after.x_mm - 120, after.y_mm - 220), 0.1);
}

TEST_F(Watch, WaitsUntilAShiftHasLasted) {
  EXPECT_EQ(see(pitched(2 * one_row_deg), 1s).state, DriftState::steady) << "a bump that passes";
  EXPECT_EQ(see(pitched(0), 3s).state, DriftState::steady);
  EXPECT_EQ(see(pitched(9 * one_row_deg), 1s).state, DriftState::steady);
  EXPECT_EQ(see(pitched(9 * one_row_deg), 1s).state, DriftState::moved);
}

TEST_F(Watch, DoesNotSwingBetweenStates) {
  EXPECT_EQ(see(pitched(1.5 * one_row_deg), 3s).state, DriftState::moved_slightly);
  EXPECT_EQ(see(pitched(0.9 * one_row_deg), 3s).state, DriftState::moved_slightly);
  EXPECT_EQ(see(pitched(0.3 * one_row_deg), 3s).state, DriftState::steady);
  EXPECT_EQ(see(pitched(0.9 * one_row_deg), 3s).state, DriftState::steady);
}

TEST_F(Watch, StaysMovedOnceItWas) {
  see(pitched(5 * one_row_deg), 3s);
  EXPECT_EQ(see(pitched(0), 10s).state, DriftState::moved) << "nothing tells whether it also turned sideways";
  EXPECT_THAT(drift_text(DriftState::moved), HasSubstr("calibrate again"));
}

TEST_F(Watch, SaysWhenTheBorderIsNotSeenForLong) {
  see(pitched(0), 1s);
  EXPECT_EQ(see({}, 9s).state, DriftState::steady) << "a hand in front of it";
  EXPECT_EQ(see({}, 2s).state, DriftState::unseen);
  EXPECT_EQ(see(pitched(0), 3s).state, DriftState::steady);
}

TEST_F(Watch, JudgesNothingFromOneHalfOfTheBorder) {
  const RigCamera moved = camera([](RigCameraParameters& p) { p.pitch_deg += 5 * one_row_deg; });
  EXPECT_EQ(see(shifts_of(moved, 700), 5s).state, DriftState::steady);
}

TEST_F(Watch, IsNotMisledByAFewWrongColumns) {
  BorderShifts shifts = pitched(0);
  for (const std::size_t i : {2U, 3U, 4U, 10U, 11U, 17U})
    shifts[i].shift_px = 8;
  EXPECT_EQ(see(shifts, 5s).state, DriftState::steady);
}

// The promise that lets it correct at all.
TEST(DriftCorrection, NeverMakesTouchesWorseWhateverMovedTheCamera) {
  RandomRigs random(41);
  int corrected = 0;
  for (int i = 0; i < 400; ++i) {
    const KnownRig rig = random.rig();
    RigCameraParameters parameters = rig.model.camera.parameters();
    const double amount = random.between(-1, 1);
    switch (i % 5) {
      case 0:
        parameters.pitch_deg += 0.15 * amount;
        break;
      case 1:
        parameters.roll_deg += 0.15 * amount;
        break;
      case 2:
        parameters.position_mm.y_mm += 3 * amount;
        break;
      case 3:
        parameters.position_mm.z_mm += 1 * amount;
        break;
      default:
        parameters.position_mm.x_mm += 3 * amount;
        break;
    }
    const ImageSize image = rig.model.camera.image();
    const RigCamera moved(parameters, image);
    BorderShifts shifts;
    for (std::size_t c = 0; c < border_columns; ++c) {
      const double u = (static_cast<double>(c) + 0.5) / border_columns * image.width_px;
      const auto row = border_row(moved, rig.screen.height_mm, u);
      const auto calibrated = border_row(rig.model.camera, rig.screen.height_mm, u);
      if (row && calibrated) shifts.push_back({u, *row - *calibrated});
    }
    DriftWatch watch(rig.model.camera, rig.screen);
    for (int tenth = 0; tenth < 30; ++tenth)
      watch.update(shifts, Timestamp{} + tenth * 100ms);
    if (watch.update(shifts, Timestamp{} + 4s).state != DriftState::moved_slightly) continue;
    ++corrected;
    double before = 0, after = 0;
    for (const ScreenPoint& place : random.places(rig, 9)) {
      const ImagePoint seen = moved.project(place).value();
      const auto old_place = rig.model.camera.screen_point(seen);
      const auto new_place = watch.corrected_camera().screen_point(seen);
      ASSERT_TRUE(old_place && new_place);
      before += std::hypot(old_place->x_mm - place.x_mm, old_place->y_mm - place.y_mm) / 9;
      after += std::hypot(new_place->x_mm - place.x_mm, new_place->y_mm - place.y_mm) / 9;
    }
    EXPECT_LE(after, before + 0.1) << "kind " << i % 5 << ", rig " << i;
  }
  EXPECT_GT(corrected, 60);
}

}  // namespace
}  // namespace telehug
