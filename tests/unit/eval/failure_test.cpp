// SPDX-License-Identifier: Apache-2.0
#include "eval/failure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doubles/aligned_rig.hpp"
#include "eval/failure_pictures.hpp"
#include "eval/place_in_picture.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

TEST(Failures, AreWhatWasMissedFarOffOrNotThere) {
  TouchScore score;
  score.touches = {{"1", "II", "chat", true, 1, 1, {10, 20}, "touch"},
                   {"2", "II", "chat", true, 30, 40, {10, 20}, "touch ring"},
                   {"3", "V", "black", false, 0, 0, {10, 20}, "touch"}};
  score.rests = {{"4", "", "black", "hover", {{1, 2}}, 23.0, "hover"}, {"5", "", "black", "nohand"}};
  score.extras = {{"1", {3, 4}}};
  const auto failures = failures_of(score);
  ASSERT_THAT(failures, SizeIs(4));
  EXPECT_EQ(failures[0].kind, FailureKind::far);
  EXPECT_DOUBLE_EQ(failures[0].size_mm, 50);
  EXPECT_DOUBLE_EQ(failures[0].found->x_mm, 50);
  EXPECT_THAT(failures[0].what, HasSubstr("50.0 mm off; tone II, screen chat, touch ring"));
  EXPECT_EQ(failures[1].kind, FailureKind::missed);
  EXPECT_EQ(failures[2].kind, FailureKind::false_touch);
  EXPECT_THAT(failures[2].what, HasSubstr("23 mm above"));
  EXPECT_EQ(failures[3].frame, "1");
}

std::vector<FailurePicture> pictures(std::initializer_list<std::pair<FailureKind, double>> failures) {
  std::vector<FailurePicture> pictures;
  for (const auto& [kind, size_mm] : failures)
    pictures.push_back({{kind, std::to_string(pictures.size()), "", size_mm}, {}, {}, {}, {}});
  return pictures;
}

TEST(Failures, ShareThePageWithTheBiggestFirst) {
  using enum FailureKind;
  const auto shared =
      share_out(pictures({{far, 20}, {far, 50}, {far, 30}, {far, 40}, {missed, 0}, {false_touch, 9}}), 5);
  ASSERT_THAT(shared, SizeIs(5));
  EXPECT_EQ(shared[0].failure.kind, missed);
  EXPECT_DOUBLE_EQ(shared[1].failure.size_mm, 50);
  EXPECT_DOUBLE_EQ(shared[3].failure.size_mm, 30);
  EXPECT_EQ(shared[4].failure.kind, false_touch);
}

TEST(PlacesInThePicture, OfTheThesisModelLeadBackToTheScreen) {
  const AlignedRig rig{{380, 300, 1280, 1024}, 187, -12, 950.0 * 40, -950};
  const MeasuredTouch first = rig.project({190, 100});
  const MeasuredTouch second = rig.project({220, 220});
  const ThesisTouchModel model = ThesisTouchModel::solve(rig.screen, first, second).value();
  const Calibration calibration{"",         "",          {1280, 720},
                                rig.screen, {200, 0.01}, ThesisCalibration{{first, second}, model}};
  const ScreenPoint place{150, 200};
  const auto seen = place_in_picture(calibration, place);
  ASSERT_TRUE(seen.has_value());
  const auto back = model.screen_point(seen->v_px - calibration.border.v_at(seen->u_px), seen->u_px - 639.5);
  ASSERT_TRUE(back.has_value());
  EXPECT_NEAR(back->x_mm, place.x_mm, 0.1);
  EXPECT_NEAR(back->y_mm, place.y_mm, 0.1);
  EXPECT_FALSE(place_in_picture(calibration, {150, -200}).has_value());
}

}  // namespace
}  // namespace telehug
