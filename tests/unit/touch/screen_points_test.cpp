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

// Seen by a camera 45 mm in front of the screen.
class ScreenPointsOfMeasuredFingers : public testing::Test {
 protected:
  [[nodiscard]] static Finger finger(const ImagePoint& tip) {
    Finger seen{tip, 50, tip.u_px - 30, tip.u_px + 30};
    seen.width_px = 60;
    seen.px_per_mm = 4;
    return seen;
  }
  [[nodiscard]] ScreenPoint touched(const Finger& seen) const {
    return screen_points({seen}, model_, screen_, image).fingers.at(0).screen;
  }

  const ScreenSize screen_{380, 300, 1280, 1024};
  const ScreenPoint contact_{150, 220};
  const RigModel model_{RigCamera({950, 0, {190, -15, 45}, 0, 0, 0}, image), 12};
};

TEST_F(ScreenPointsOfMeasuredFingers, LieBelowTheVisibleTipIfOnlyThatIsKnown) {
  const ImagePoint tip = *tip_of_contact(model_.camera, model_.contact_radius_mm, contact_);
  EXPECT_NEAR(touched(finger(tip)).y_mm, contact_.y_mm, 1e-6);
  EXPECT_NEAR(touched(finger(tip)).x_mm, contact_.x_mm, 1e-6);
}

TEST_F(ScreenPointsOfMeasuredFingers, LieWhereTheDetectorSawTheContact) {
  Finger seen = finger(*tip_of_contact(model_.camera, model_.contact_radius_mm, contact_));
  seen.contact = *model_.camera.project(ScreenPoint{151, 222});
  EXPECT_NEAR(touched(seen).x_mm, 151, 1e-6);
  EXPECT_NEAR(touched(seen).y_mm, 222, 1e-6);
}

TEST_F(ScreenPointsOfMeasuredFingers, AreKeptBelowTheScreenWhereHoveringFingersAreSeen) {
  const ImagePoint tip = *model_.camera.project(ScreenPoint{150, screen_.height_mm + 60});
  const TouchedPoints hovering = screen_points({finger(tip)}, model_, screen_, image);
  ASSERT_EQ(hovering.fingers.size(), 1U);
  EXPECT_NEAR(hovering.fingers[0].width_mm, 15, 1e-9);
  Finger unmeasured = finger(tip);
  unmeasured.px_per_mm = 0;
  EXPECT_EQ(screen_points({unmeasured}, model_, screen_, image).dropped, 1U);
}

}  // namespace
}  // namespace telehug
