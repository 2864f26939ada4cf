// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibration_dot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "calibration/calibration.hpp"
#include "calibration/calibration_policy.hpp"
#include "calibration/dot_touches.hpp"
#include "doubles/drawn_dots.hpp"

namespace telehug {
namespace {

const ScreenSize screen{380, 300, 1280, 1024};

RigCamera camera_of(ImageSize image, PictureOrientation orientation = {}) {
  return {{1000 * image.width_px / 1280.0, -0.03, {196, -8, 47}, 1.2, -0.8, 1.5}, image, orientation};
}

class ADot : public testing::Test {
 protected:
  static constexpr ImageSize image{1280, 720};
  const RigCamera camera = camera_of(image);
  const BorderLine border = border_line(camera, screen);
  const ScreenPoint place{230, 220};
  const ImagePoint truth = camera.project(place).value();

  static double off_px(const std::optional<CalibrationDot>& dot, const ImagePoint& truth) {
    return dot ? std::hypot(dot->centre.u_px - truth.u_px, dot->centre.v_px - truth.v_px) : 1e9;
  }
};

TEST_F(ADot, IsFoundWithoutAFinger) {
  const auto dot = find_calibration_dot(DrawnDots(camera).dot(place).picture(), border);
  EXPECT_LT(off_px(dot, truth), 0.6);
  EXPECT_GT(dot->score, 0.9);
}

TEST_F(ADot, IsFoundUnderTheFingerThatHidesHalfOfIt) {
  const auto dot = find_calibration_dot(DrawnDots(camera).dot(place).finger(place).picture(), border);
  EXPECT_LT(off_px(dot, truth), 0.8);
}

TEST_F(ADot, IsFoundEverywhereInPicturesOfAllSizes) {
  for (const ImageSize size : {ImageSize{640, 480}, {1280, 960}, {1920, 1080}}) {
    const RigCamera other = camera_of(size);
    const double px = size.width_px / 1280.0;
    for (const ScreenPoint& at : {ScreenPoint{190, 200}, {60, 270}, {330, 270}, {160, 285}}) {
      const auto dot = find_calibration_dot(DrawnDots(other).dot(at).finger(at).picture(), border_line(other, screen));
      EXPECT_LT(off_px(dot, other.project(at).value()), 1.2 * px)
          << size.width_px << ": " << at.x_mm << ", " << at.y_mm;
    }
  }
}

TEST_F(ADot, IsMeasuredToPartsOfAPixelWhenTheCameraIsKnown) {
  double squares = 0;
  int count = 0;
  for (const ScreenPoint& at : {ScreenPoint{190, 200}, {60, 270}, {330, 270}, {160, 285}, {230, 170}}) {
    const ImagePoint exact = camera.project(at).value();
    const cv::Mat picture = DrawnDots(camera).dot(at).finger(at).picture();
    const auto dot = refine_calibration_dot(picture, camera, {exact.u_px + 1.5, exact.v_px - 1});
    ASSERT_TRUE(dot.has_value());
    EXPECT_NEAR(dot->centre.u_px, exact.u_px, 3 * dot->sigma_u_px);
    EXPECT_NEAR(dot->centre.v_px, exact.v_px, 3 * dot->sigma_v_px);
    squares += std::pow(off_px(dot, exact), 2);
    ++count;
  }
  EXPECT_LT(std::sqrt(squares / count), 0.25);
}

TEST_F(ADot, IsNotDrawnAwayByItsOwnOverexposedLight) {
  cv::Mat picture = DrawnDots(camera).dot(place).finger(place).picture();
  picture.convertTo(picture, CV_8UC3, 2.2, -60);  // the edge's bright half is lost
  const auto dot = refine_calibration_dot(picture, camera, truth);
  ASSERT_TRUE(dot.has_value());
  EXPECT_NEAR(dot->centre.v_px, truth.v_px, 0.3);
}

TEST_F(ADot, IsMissedWhereThereIsNone) {
  EXPECT_FALSE(find_calibration_dot(DrawnDots(camera).picture(), border).has_value());
  EXPECT_FALSE(find_calibration_dot(DrawnDots(camera).finger(place).picture(), border).has_value());
  const cv::Scalar pale(190, 200, 210);
  EXPECT_FALSE(find_calibration_dot(DrawnDots(camera).finger(place, pale).picture(), border).has_value());
  // A lit window, mirrored.
  EXPECT_FALSE(find_calibration_dot(DrawnDots(camera).dot(place, {225, 222, 220}, 60).picture(), border).has_value());
}

TEST_F(ADot, IsLookedForBelowTheBorderOnly) {
  const ScreenPoint below_the_screen{200, 340};
  EXPECT_FALSE(find_calibration_dot(DrawnDots(camera).dot(below_the_screen).picture(), border).has_value());
}

TEST_F(ADot, IsRefusedWhereTheCameraIsSaidToSeeItElsewhere) {
  const cv::Mat picture = DrawnDots(camera).dot(place).picture();
  EXPECT_FALSE(refine_calibration_dot(picture, camera, {truth.u_px + 40, truth.v_px}).has_value());
}

TEST_F(ADot, NeedsAColourPicture) {
  EXPECT_THROW((void)find_calibration_dot(cv::Mat(720, 1280, CV_8UC1), border), std::invalid_argument);
}

class ACalibrationWithDots : public testing::Test {
 protected:
  const RigCamera camera = camera_of({1280, 720});
  const BorderLine border = border_line(camera, screen);
  const std::vector<ScreenPoint> places{{190, 190}, {220, 260}, {92, 216}, {292, 216},
                                        {60, 270},  {310, 270}, {140, 285}};

  [[nodiscard]] std::vector<DotPicture> pictures() const {
    std::vector<DotPicture> taken;
    for (const ScreenPoint& at : places)
      taken.push_back({DrawnDots(camera).dot(at).finger(at).picture(taken.size()), at, std::nullopt});
    return taken;
  }
  [[nodiscard]] Result<BorderChosen> solved(std::vector<DotPicture>& pictures) const {
    find_dots(pictures, border);
    return solve_with_dots({screen, {1280, 720}, {}, {}, {}}, pictures, {});
  }
};

TEST_F(ACalibrationWithDots, FindsTheCameraToPartsOfAMillimetre) {
  auto taken = pictures();
  const auto found = solved(taken);
  ASSERT_TRUE(found.ok()) << found.error().message;
  const RigModel& model = found->calibration.solution.model;
  for (const ScreenPoint& at : {ScreenPoint{130, 200}, {250, 240}, {190, 290}, {280, 285}}) {
    const auto placed = model.camera.screen_point(camera.project(at).value());
    ASSERT_TRUE(placed.has_value());
    EXPECT_NEAR(placed->x_mm, at.x_mm, 0.3);
    EXPECT_NEAR(placed->y_mm, at.y_mm, 0.5);
  }
  for (const TouchResidual& touch : found->calibration.solution.touches)
    EXPECT_LT(std::hypot(touch.error_mm.x_mm, touch.error_mm.y_mm), 0.4);
  // Nothing tells how large the finger is.
  EXPECT_NEAR(model.contact_radius_mm, 15.4, 0.01);
}

TEST_F(ACalibrationWithDots, TellsWhichTwoWereExchanged) {
  auto taken = pictures();
  std::swap(taken[1].screen, taken[4].screen);
  const auto found = solved(taken);
  ASSERT_TRUE(found.ok()) << found.error().message;
  const auto verdict = judge_calibration(found->calibration, places);
  ASSERT_TRUE(verdict.exchanged.has_value());
  EXPECT_EQ(*verdict.exchanged, (std::pair<std::size_t, std::size_t>{1, 4}));
}

TEST_F(ACalibrationWithDots, TellsWhichOneWasElsewhere) {
  auto taken = pictures();
  taken[3].screen = {250, 216};
  const auto found = solved(taken);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_EQ(found->calibration.solution.bad_touch, 3U);
  EXPECT_EQ(judge_calibration(found->calibration, places).repeat, 3U);
}

TEST_F(ACalibrationWithDots, GoesWithoutTheOneThatIsMissing) {
  auto taken = pictures();
  taken[2].bgr = DrawnDots(camera).picture();
  const auto found = solved(taken);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_EQ(found->calibration.observations.touches.size(), places.size() - 1);
}

TEST_F(ACalibrationWithDots, IsNoneIfMostPicturesShowNoDot) {
  auto taken = pictures();
  for (std::size_t i = 0; i + 3 < taken.size(); ++i)
    taken[i].bgr = DrawnDots(camera).picture();
  find_dots(taken, border);
  EXPECT_TRUE(dot_touches(taken).empty());
}

}  // namespace
}  // namespace telehug
