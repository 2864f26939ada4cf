// SPDX-License-Identifier: Apache-2.0
#include "touch/screen_points.hpp"

#include <gtest/gtest.h>

#include "doubles/aligned_rig.hpp"

namespace telehug {
namespace {

constexpr ImageSize image{1280, 720};

class ScreenPointsOfFingers : public testing::Test {
 protected:
  [[nodiscard]] Finger finger_at(const ScreenPoint& point) const {
    const MeasuredTouch seen = rig_.project(point);
    const double u_px = seen.column_px + 639.5;
    return {{u_px, 500 + seen.length_px}, seen.length_px, u_px - 30, u_px + 30};
  }

  AlignedRig rig_{{380, 300, 1280, 1024}, 187, 12, 950.0 * 40, -950};
  ThesisTouchModel model_ =
      ThesisTouchModel::solve(rig_.screen, rig_.project({190, 100}), rig_.project({220, 220})).value();
};

TEST_F(ScreenPointsOfFingers, AreWhereTheFingersTouch) {
  const Fingers fingers{finger_at({50, 250}), finger_at({300, 120})};
  const TouchedPoints touched = screen_points(fingers, model_, rig_.screen, image);
  ASSERT_EQ(touched.fingers.size(), 2U);
  EXPECT_EQ(touched.dropped, 0U);
  EXPECT_NEAR(touched.fingers[0].screen.x_mm, 50, 1e-9);
  EXPECT_NEAR(touched.fingers[0].screen.y_mm, 250, 1e-9);
  EXPECT_NEAR(touched.fingers[1].screen.x_mm, 300, 1e-9);
  EXPECT_NEAR(touched.fingers[1].screen.y_mm, 120, 1e-9);
}

TEST_F(ScreenPointsOfFingers, AreDroppedFarOutsideTheScreenAndCounted) {
  const Fingers fingers{finger_at({-15, 250}), finger_at({-25, 250}), finger_at({405, 250}), finger_at({100, 200})};
  const TouchedPoints touched = screen_points(fingers, model_, rig_.screen, image);
  EXPECT_EQ(touched.fingers.size(), 2U);
  EXPECT_EQ(touched.dropped, 2U);
}

TEST_F(ScreenPointsOfFingers, AreDroppedWhereTheModelPlacesNothing) {
  Finger finger = finger_at({100, 200});
  finger.length_px = -1e5;
  const TouchedPoints touched = screen_points({finger}, model_, rig_.screen, image);
  EXPECT_TRUE(touched.fingers.empty());
  EXPECT_EQ(touched.dropped, 1U);
}

}  // namespace
}  // namespace telehug
