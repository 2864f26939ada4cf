// SPDX-License-Identifier: Apache-2.0
//
// The calibration's dots on rendered rigs, whose cameras are known exactly.
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/calibration.hpp"
#include "calibration/dot_touches.hpp"
#include "capture/virtual_rig/virtual_rig.hpp"
#include "common/clock.hpp"

namespace telehug {
namespace {

class VirtualDots : public testing::TestWithParam<VirtualRigSettings> {};

TEST_P(VirtualDots, PlaceTheCameraToPartsOfAMillimetre) {
  const SteadyClock clock;
  VirtualRig rig(GetParam(), clock);
  const VirtualRigSettings& settings = rig.settings();
  const auto row = [&](double x_mm) { return rig.camera().project({x_mm, settings.screen.height_mm, 0}); };
  const ImagePoint left = row(0.8 * settings.screen.width_mm), right = row(0.2 * settings.screen.width_mm);
  const double slope = (right.v_px - left.v_px) / (right.u_px - left.u_px);
  const BorderLine border{left.v_px - slope * left.u_px, slope};

  EXPECT_FALSE(find_calibration_dot(rig.picture_of_background(), border).has_value());
  std::vector<DotPicture> pictures;
  for (const ScreenPoint& point : calibration_points(settings))
    pictures.push_back({rig.picture_of_touch(point), point, std::nullopt});
  find_dots(pictures, border);
  ASSERT_EQ(dot_touches(pictures).size(), pictures.size());
  const auto solved = solve_with_dots({settings.screen, settings.image, {}, {}, {}}, pictures, {});
  ASSERT_TRUE(solved.ok()) << solved.error().message;

  const double px = settings.image.width_px / 1280.0;
  for (const DotPicture& picture : pictures) {
    const ImagePoint truth = rig.camera().project({picture.screen.x_mm, picture.screen.y_mm, 0});
    EXPECT_NEAR(picture.dot->centre.u_px, truth.u_px, 0.6 * px);
    EXPECT_NEAR(picture.dot->centre.v_px, truth.v_px, 0.35 * px);
    const auto placed = solved->calibration.solution.model.camera.screen_point(truth);
    ASSERT_TRUE(placed.has_value());
    EXPECT_NEAR(placed->x_mm, picture.screen.x_mm, 0.15);
    EXPECT_NEAR(placed->y_mm, picture.screen.y_mm, 0.3);
  }
}

VirtualRigSettings tilted(ImageSize image) {
  VirtualRigSettings settings;
  settings.image = image;
  settings.focal_px = 1000 * image.width_px / 1280.0;
  settings.camera = {{201, -9, 44}, 1.5, -1, -1.2};
  return settings;
}

INSTANTIATE_TEST_SUITE_P(Rigs, VirtualDots,
                         testing::Values(VirtualRigSettings{}, tilted({1280, 720}), tilted({640, 480})));

}  // namespace
}  // namespace telehug
