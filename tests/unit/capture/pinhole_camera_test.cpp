// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/pinhole_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace telehug {
namespace {

constexpr ImageSize image{1280, 720};

TEST(PinholeCamera, FollowsTheFormulaOfAnAlignedCamera) {
  const PinholeCamera camera({{190, -15, 55}}, 950, image);
  for (const double x : {20.0, 190.0, 300.0}) {
    for (const double y : {140.0, 220.0, 300.0}) {
      const ImagePoint p = camera.project({x, y, 0});
      EXPECT_NEAR(p.u_px, 639.5 - 950 * (x - 190) / (y + 15), 1e-9);
      EXPECT_NEAR(p.v_px, 359.5 + 950 * 55 / (y + 15), 1e-9);
    }
  }
}

TEST(PinholeCamera, SeesTheUsersSideAboveAndTheUsersLeftOnTheRight) {
  const PinholeCamera camera({{190, -15, 55}}, 950, image);
  const ImagePoint on_screen = camera.project({190, 250, 0});
  EXPECT_LT(camera.project({190, 250, 40}).v_px, on_screen.v_px);
  EXPECT_GT(camera.project({150, 250, 0}).u_px, on_screen.u_px);
}

TEST(PinholeCamera, LooksAlongTheRayThroughTheImageOfAPointHoweverItIsTurned) {
  const PinholeCamera camera({{180, -20, 60}, 3, -4, 2.5}, 900, image);
  const RigPoint point{150, 260, 12};
  const ImagePoint p = camera.project(point);
  const RigPoint ray = camera.ray(p.u_px, p.v_px);
  EXPECT_LT(cv::norm(ray.cross(point - camera.position_mm())), 1e-6);
  EXPECT_NEAR(camera.depth_mm(camera.position_mm() + ray), 1, 1e-12);
}

TEST(PinholeCamera, TurnsThePictureWithItsAngles) {
  const RigPoint far_left{0, 300, 0};
  const RigPoint far_right{380, 300, 0};
  const PinholeCamera rolled({{190, -15, 55}, 0, 0, 2}, 950, image);
  const double slope = (rolled.project(far_left).v_px - rolled.project(far_right).v_px) /
                       (rolled.project(far_left).u_px - rolled.project(far_right).u_px);
  EXPECT_NEAR(std::atan(slope) * 180 / 3.14159265358979, 2, 1e-6);  // clockwise: the right end sinks

  const PinholeCamera straight({{190, -15, 55}}, 950, image);
  const PinholeCamera towards_user({{190, -15, 55}, 2, 0, 0}, 950, image);
  EXPECT_GT(towards_user.project({190, 300, 0}).v_px, straight.project({190, 300, 0}).v_px);
  const PinholeCamera towards_left({{190, -15, 55}, 0, 2, 0}, 950, image);
  EXPECT_LT(towards_left.project({190, 300, 0}).u_px, straight.project({190, 300, 0}).u_px);
}

TEST(PinholeCamera, LooksAlongTheRayThroughTheImageOfAPointHoweverItsLensDistorts) {
  for (const double k1 : {-0.2, -0.08, 0.08, 0.2}) {
    const PinholeCamera camera({{190, -15, 50}, 3, -2, 4}, 900, {1280, 720}, k1);
    for (const ImagePoint p : {ImagePoint{0, 0}, {1279, 719}, {640, 360}, {100, 650}}) {
      const ImagePoint again = camera.project(camera.position_mm() + camera.ray(p.u_px, p.v_px) * 250);
      EXPECT_NEAR(again.u_px, p.u_px, 1e-6) << k1;
      EXPECT_NEAR(again.v_px, p.v_px, 1e-6) << k1;
    }
  }
}

TEST(PinholeCamera, KeepsWhatLiesFarBesideThePictureOutOfIt) {
  const PinholeCamera camera({{190, -15, 50}, 0, 0, 0}, 900, {1280, 720}, -0.08);
  for (double x_mm = 500; x_mm < 5000; x_mm += 100)
    EXPECT_LT(camera.project({x_mm, 100, 0}).u_px, 0) << x_mm;
}

}  // namespace
}  // namespace telehug
