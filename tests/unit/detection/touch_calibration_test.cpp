// SPDX-License-Identifier: Apache-2.0
#include "detection/touch_calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "calibration/calibration_page.hpp"
#include "calibration/calibration_policy.hpp"
#include "doubles/drawn_bezel.hpp"
#include "doubles/drawn_dots.hpp"

namespace telehug {
namespace {

const ScreenSize screen{380, 300, 1280, 1024};

class ACalibrationWithPictures : public testing::Test {
 protected:
  const RigCamera camera{{1000, -0.03, {196, -8, 47}, 1.2, -0.8, 1.5}, {1280, 720}};
  const std::vector<ScreenPoint> places{{190, 190}, {220, 260}, {92, 216}, {292, 216},
                                        {60, 270},  {310, 270}, {140, 285}};

  // Nothing but black, and dots with a finger on them: no edge of the screen is seen.
  [[nodiscard]] CalibrationPictures pictures() const {
    CalibrationPictures taken{screen, DrawnDots(camera).picture(99), std::nullopt, std::nullopt, {}};
    for (const ScreenPoint& at : places)
      taken.touches.push_back({DrawnDots(camera).dot(at).finger(at).picture(taken.touches.size()), at});
    return taken;
  }

  // The first of the touches, and the page of marks.
  [[nodiscard]] CalibrationPictures pictures_with_marks(std::size_t touches) const {
    CalibrationPictures taken = pictures();
    taken.touches.resize(touches);
    DrawnDots page(camera);
    for (const ScreenPoint& mark : mark_points(screen))
      page.dot(mark);
    taken.marks = page.picture(98);
    return taken;
  }

  void expect_true_camera(const RigCalibration& found) const {
    for (const ScreenPoint& at : {ScreenPoint{130, 200}, {250, 240}, {190, 290}, {280, 285}}) {
      const auto placed = found.solution.model.camera.screen_point(camera.project(at).value());
      ASSERT_TRUE(placed.has_value());
      EXPECT_NEAR(placed->x_mm, at.x_mm, 0.3);
      EXPECT_NEAR(placed->y_mm, at.y_mm, 0.5);
    }
  }
};

TEST_F(ACalibrationWithPictures, FindsTheCameraToPartsOfAMillimetre) {
  const auto found = calibrate_with_pictures(pictures());
  ASSERT_TRUE(found.ok()) << found.error().message;
  expect_true_camera(*found);
  for (const TouchResidual& touch : found->solution.touches)
    EXPECT_LT(std::hypot(touch.error_mm.x_mm, touch.error_mm.y_mm), 0.4);
  // Nothing tells how large the finger is.
  EXPECT_NEAR(found->solution.model.contact_radius_mm, 15.4, 0.01);
}

TEST_F(ACalibrationWithPictures, BelievesTheDotsMoreThanALongerEdgeThanTheScreens) {
  CalibrationPictures taken = pictures();
  // As if the camera stood elsewhere: the bezel lies lower in this picture than the screen that the dots tell of.
  const RigCamera elsewhere{{1000, -0.03, {196, -8, 60}, 1.2, -0.8, 1.5}, {1280, 720}};
  taken.triangle = drawn_bezel(elsewhere, screen);
  const auto found = calibrate_with_pictures(taken);
  ASSERT_TRUE(found.ok()) << found.error().message;
  expect_true_camera(*found);
}

TEST_F(ACalibrationWithPictures, TellsWhichTwoWereExchangedAndGoesWithoutThem) {
  CalibrationPictures taken = pictures();
  std::swap(taken.touches[1].screen, taken.touches[4].screen);
  const auto found = calibrate_with_pictures(taken);
  ASSERT_TRUE(found.ok()) << found.error().message;
  const auto verdict = judge_calibration(*found, places);
  ASSERT_TRUE(verdict.exchanged.has_value());
  EXPECT_EQ(*verdict.exchanged, (std::pair<std::size_t, std::size_t>{1, 4}));
  expect_true_camera(*found);
}

TEST_F(ACalibrationWithPictures, TellsWhichOneWasElsewhere) {
  CalibrationPictures taken = pictures();
  taken.touches[3].screen = {250, 216};
  const auto found = calibrate_with_pictures(taken);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_TRUE(found->observations.touches[3].left_out);
  EXPECT_EQ(judge_calibration(*found, places).repeat, 3U);
}

TEST_F(ACalibrationWithPictures, GoesWithoutTheOneThatIsMissing) {
  CalibrationPictures taken = pictures();
  taken.touches[2].bgr = DrawnDots(camera).picture();
  const auto found = calibrate_with_pictures(taken);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_EQ(found->observations.touches.size(), places.size() - 1);
}

TEST_F(ACalibrationWithPictures, IsNoneIfNoPictureShowsATouch) {
  CalibrationPictures taken = pictures();
  for (CalibrationPictures::Touch& touch : taken.touches)
    touch.bgr = DrawnDots(camera).picture();
  const auto found = calibrate_with_pictures(taken);
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().message, testing::HasSubstr("found in 0 of 7 calibration pictures"));
}

TEST_F(ACalibrationWithPictures, NeedsTwoTouchesIfThereAreMarks) {
  const auto found = calibrate_with_pictures(pictures_with_marks(2));
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_TRUE(judge_calibration(*found, {places[0], places[1]}).good());
  EXPECT_GE(found->observations.marks.size(), 8U);
  expect_true_camera(*found);
}

TEST_F(ACalibrationWithPictures, TellsByTheMarksWhichOfTwoTouchesWasElsewhere) {
  CalibrationPictures taken = pictures_with_marks(2);
  taken.touches[1].screen.x_mm += 15;
  const auto found = calibrate_with_pictures(taken);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_FALSE(found->observations.touches[0].left_out);
  EXPECT_TRUE(found->observations.touches[1].left_out);
  expect_true_camera(*found);
}

TEST_F(ACalibrationWithPictures, GoesWithoutMarksThatContradictTheTouches) {
  CalibrationPictures taken = pictures_with_marks(places.size());
  // As if they had been shown in a window that begins farther right and down.
  DrawnDots page(camera);
  for (const ScreenPoint& mark : mark_points(screen))
    page.dot({mark.x_mm + 18, mark.y_mm + 6});
  taken.marks = page.picture(97);
  const auto found = calibrate_with_pictures(taken);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_TRUE(found->observations.marks.empty());
  EXPECT_TRUE(judge_calibration(*found, places).good());
  expect_true_camera(*found);
}

TEST_F(ACalibrationWithPictures, GoesWithoutMarksThatAreNotShown) {
  CalibrationPictures taken = pictures();
  taken.marks = DrawnDots(camera).picture(96);
  const auto found = calibrate_with_pictures(taken);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_TRUE(found->observations.marks.empty());
  expect_true_camera(*found);
}

}  // namespace
}  // namespace telehug
