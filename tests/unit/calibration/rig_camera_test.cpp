// SPDX-License-Identifier: Apache-2.0
#include "calibration/rig_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/rig_model.hpp"
#include "doubles/allocation_counter.hpp"
#include "doubles/random_rig.hpp"

namespace telehug {
namespace {

constexpr ImageSize image{1280, 720};
constexpr ScreenPoint middle{190, 200};

ImagePoint seen(const RigCameraParameters& parameters, PictureOrientation orientation = {}) {
  return RigCamera(parameters, image, orientation).project(middle).value();
}

TEST(RigCamera, SeesAPointWhereTheFormulaSays) {
  const auto at = RigCamera({1000, 0, {190, -15, 50}}, image).project(RigVector{230, 185, 20});
  ASSERT_TRUE(at.has_value());
  EXPECT_NEAR(at->u_px, 639.5 - 1000 * 40 / 200.0, 1e-9);
  EXPECT_NEAR(at->v_px, 359.5 + 1000 * 30 / 200.0, 1e-9);
}

TEST(RigCamera, TurnsAsItsAnglesSay) {
  const RigCameraParameters straight{1000, 0, {190, -15, 50}};
  const ImagePoint before = seen(straight);
  RigCameraParameters turned = straight;
  turned.pitch_deg = 1;  // towards the user: the screen moves down in the picture, whose top points to the user
  EXPECT_GT(seen(turned).v_px, before.v_px + 10);
  turned = straight;
  turned.yaw_deg = 1;  // towards the user's left, the picture's right: the screen moves to the left
  EXPECT_LT(seen(turned).u_px, before.u_px - 10);
  turned = straight;
  turned.roll_deg = 1;  // clockwise: what is below the centre moves to the left
  EXPECT_LT(seen(turned).u_px, before.u_px - 1);
  EXPECT_NEAR(std::hypot(seen(turned).u_px - 639.5, seen(turned).v_px - 359.5),
              std::hypot(before.u_px - 639.5, before.v_px - 359.5), 1e-9);
}

TEST(RigCamera, MovesPointsAwayFromTheCentreByItsDistortion) {
  const RigCameraParameters straight{1000, 0.05, {190, -15, 50}};
  const double r = 50 / 215.0;
  EXPECT_NEAR(seen(straight).v_px, 359.5 + 1000 * r * (1 + 0.05 * r * r), 1e-9);
}

TEST(RigCamera, ExchangesTheSidesOfAMirroredPicture) {
  const RigCameraParameters parameters{1000, 0.02, {200, -15, 50}, 1, 2, 3};
  const ImagePoint upright = seen(parameters);
  const ImagePoint mirrored = seen(parameters, {true, false});
  const ImagePoint upside_down = seen(parameters, {true, true});
  EXPECT_NEAR(mirrored.u_px, 1279 - upright.u_px, 1e-9);
  EXPECT_NEAR(mirrored.v_px, upright.v_px, 1e-9);
  EXPECT_NEAR(upside_down.u_px, 1279 - upright.u_px, 1e-9);
  EXPECT_NEAR(upside_down.v_px, 719 - upright.v_px, 1e-9);
}

TEST(RigCamera, FindsEveryPointAgainThatItSees) {
  RandomRigs random(1);
  int seen_points = 0;
  for (int i = 0; i < 5000; ++i) {
    const KnownRig rig = random.rig({i % 2 == 0, i % 3 == 0});
    const double z_mm = i % 5 == 0 ? random.between(0, 15) : 0;
    const ScreenPoint place{random.between(0, rig.screen.width_mm), random.between(60, rig.screen.height_mm)};
    const auto at = rig.model.camera.project(RigVector{place.x_mm, place.y_mm, z_mm});
    if (!at) continue;
    const auto found = rig.model.camera.screen_point(*at, z_mm);
    ASSERT_TRUE(found.has_value());
    ASSERT_NEAR(found->x_mm, place.x_mm, 1e-9);
    ASSERT_NEAR(found->y_mm, place.y_mm, 1e-9);
    ++seen_points;
  }
  EXPECT_GT(seen_points, 4900);
}

TEST(RigCamera, PlacesNothingAboveTheHorizon) {
  const RigCamera camera({1000, 0, {190, -15, 50}}, image);
  EXPECT_FALSE(camera.screen_point({640, 359}).has_value());
  EXPECT_TRUE(camera.screen_point({640, 400}).has_value());
  EXPECT_FALSE(camera.screen_point({640, 400}, 50).has_value()) << "the plane of the camera itself";
  EXPECT_FALSE(camera.project(ScreenPoint{190, -20}).has_value()) << "behind the camera";
}

TEST(RigCamera, SeesNothingWhereTheDistortionFoldsOver) {
  const RigCamera camera({400, -0.08, {190, -15, 50}}, image);
  EXPECT_FALSE(camera.project(ScreenPoint{190, 0}).has_value());
  EXPECT_FALSE(camera.screen_point({640, 360 + 400 * 1.5}).has_value());
}

TEST(RigModel, FindsTheContactBehindAGrazingRay) {
  // The virtual rig's README: 5.5 mm, y = 200 mm: 0.7 mm.
  const RigModel model{RigCamera({1100, 0, {190, -15, 50}}, image), 5.5};
  const ImagePoint tip = tip_of_contact(model.camera, 5.5, {190, 200}).value();
  const double visible_y = model.camera.screen_point(tip)->y_mm;
  EXPECT_NEAR(200 - visible_y, 5.5 * std::tan(std::atan2(50, visible_y + 15) / 2), 1e-9);
  EXPECT_NEAR(200 - visible_y, 0.63, 0.05);
}

TEST(RigModel, SeesNoPointOfABallBelowItsTip) {
  const RigModel model{RigCamera({1100, 0, {190, -15, 50}}, image), 8};
  const ScreenPoint contact{120, 220};
  const ImagePoint tip = tip_of_contact(model.camera, 8, contact).value();
  double lowest = 0;
  for (double latitude = -1.57; latitude < 1.57; latitude += 0.002) {
    const RigVector point{contact.x_mm, contact.y_mm - 8 * std::cos(latitude), 8 + 8 * std::sin(latitude)};
    lowest = std::max(lowest, model.camera.project(point)->v_px);
  }
  EXPECT_NEAR(tip.v_px, lowest, 1e-3);
}

TEST(RigModel, FindsEveryContactAgain) {
  RandomRigs random(2);
  for (int i = 0; i < 2000; ++i) {
    const KnownRig rig = random.rig();
    const ScreenPoint contact{random.between(0, rig.screen.width_mm), random.between(80, rig.screen.height_mm)};
    const auto tip = tip_of_contact(rig.model.camera, rig.model.contact_radius_mm, contact);
    if (!tip) continue;
    const auto found = rig.model.screen_point(*tip);
    ASSERT_TRUE(found.has_value());
    ASSERT_NEAR(found->x_mm, contact.x_mm, 1e-8);
    ASSERT_NEAR(found->y_mm, contact.y_mm, 1e-8);
  }
}

TEST(RigModel, PlacesATipWithoutAllocating) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has its own heap";
  const RigModel model{RigCamera({1100, -0.05, {190, -15, 50}, 1, 2, 3}, image), 8};
  const auto before = allocation_count();
  EXPECT_TRUE(model.screen_point({600, 600}).has_value());
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace telehug
