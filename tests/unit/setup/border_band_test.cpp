// SPDX-License-Identifier: Apache-2.0
#include "setup/border_band.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "calibration/rig_observations.hpp"
#include "calibration/rig_solver.hpp"

namespace telehug {
namespace {

constexpr ScreenSize screen{380, 300, 1280, 1024};
constexpr ImageSize image{1280, 720};

BorderLine at_row(double row, double deg = 0) {
  const double slope = std::tan(deg * std::numbers::pi / 180);
  return {row - slope * 639.5, slope};
}

TEST(GreenBand, LeavesRoomBeforeTheEdgeForWhatFingersComeFrom) {
  EXPECT_NEAR(green_band(screen, image, false).top_px, 215, 3);
}

TEST(GreenBand, EndsWhereAUsualCameraSeesTheLowerHalfOfTheScreen) {
  const BorderBand band = green_band(screen, image, false);
  RigParameters rig = usual_rigs(screen, image).mean;
  // The camera turned until the edge is at the band's end.
  for (int i = 0; i < 10; ++i) {
    const auto edge = make_rig_model(rig, image, {}).camera.project(ScreenPoint{190, 300});
    rig[RigParameter::pitch_deg] +=
        (band.bottom_px - edge->v_px) / rig[RigParameter::focal_px] * 180 / std::numbers::pi;
  }
  const auto middle = make_rig_model(rig, image, {}).camera.project(ScreenPoint{190, 150});
  ASSERT_TRUE(middle.has_value());
  EXPECT_NEAR(middle->v_px, 719, 25);
}

TEST(GreenBand, IsTheOtherWayRoundInPicturesThatAreUpsideDown) {
  const BorderBand upright = green_band(screen, image, false);
  const BorderBand turned = green_band(screen, image, true);
  EXPECT_DOUBLE_EQ(turned.top_px, 719 - upright.bottom_px);
  EXPECT_DOUBLE_EQ(turned.bottom_px, 719 - upright.top_px);
}

TEST(GreenBand, GrowsWithThePicture) {
  const BorderBand small = green_band(screen, {640, 360}, false);
  EXPECT_NEAR(2 * small.top_px, green_band(screen, image, false).top_px, 5);
  EXPECT_NEAR(2 * small.bottom_px, green_band(screen, image, false).bottom_px, 5);
}

TEST(CameraTurns, AreToldFromWhereTheEdgeIs) {
  const BorderBand band = green_band(screen, image, false);
  EXPECT_EQ(turn_wanted(at_row(400), band, image, false), CameraTurn::none);
  EXPECT_EQ(turn_wanted(at_row(band.bottom_px + 5), band, image, false), CameraTurn::towards_screen);
  EXPECT_EQ(turn_wanted(at_row(band.top_px - 5), band, image, false), CameraTurn::towards_user);
  EXPECT_EQ(turn_wanted(at_row(400, 3.5), band, image, false), CameraTurn::none);
  EXPECT_EQ(turn_wanted(at_row(400, -4.5), band, image, false), CameraTurn::level);
}

TEST(CameraTurns, BringTheEdgeTowardsTheBand) {
  // The way the advice is meant: pitch turns the camera towards the user and moves the screen down in the picture.
  RigParameters rig = usual_rigs(screen, image).mean;
  const auto row = [&] { return make_rig_model(rig, image, {}).camera.project(ScreenPoint{190, 300})->v_px; };
  const double before = row();
  rig[RigParameter::pitch_deg] += 3;
  EXPECT_GT(row(), before);
}

TEST(CameraTurns, AreTheSameForPicturesThatAreUpsideDown) {
  const BorderBand band = green_band(screen, image, true);
  EXPECT_EQ(turn_wanted(at_row(band.top_px - 5), band, image, true), CameraTurn::towards_screen);
  EXPECT_EQ(turn_wanted(at_row(band.bottom_px + 5), band, image, true), CameraTurn::towards_user);
}

}  // namespace
}  // namespace telehug
