// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibration_dot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "calibration/calibration.hpp"
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

}  // namespace
}  // namespace telehug
