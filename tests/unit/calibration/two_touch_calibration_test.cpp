// SPDX-License-Identifier: Apache-2.0
//
// What a calibration with the thesis' two touches is worth: the default model has the triangle's vertex, the screen's
// bottom edge and its priors on top of them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "calibration/thesis_touch_model.hpp"
#include "doubles/random_rig.hpp"

namespace telehug {
namespace {

constexpr double noise_px = 0.3;

struct MeanError {
  double vertical_mm = 0;
  double horizontal_mm = 0;
};

class TwoTouches {
 public:
  explicit TwoTouches(unsigned seed) : random_(seed) {}

  // Adds what both models make of touches all over the screen of one rig, each with noise of its own.
  void add(const KnownRig& rig) {
    // The virtual rig's and the samples' first two: the picture shows less of the screen than the thesis' camera saw.
    const std::array dots{ScreenPoint{0.5 * rig.screen.width_mm, 0.66 * rig.screen.height_mm},
                          ScreenPoint{0.5 * rig.screen.width_mm + 30, 0.86 * rig.screen.height_mm}};
    if (!rig.sees_tip(dots[0]) || !rig.sees_tip(dots[1])) return;
    const ScreenPoint vertex{0.5 * rig.screen.width_mm, rig.screen.height_mm};
    RigObservations seen = random_.observe(rig, 0, noise_px, noise_px);
    seen.marks.push_back({vertex, blurred(rig.model.camera.project(vertex).value()), 1, 1});
    for (const ScreenPoint& dot : dots)
      seen.touches.push_back({dot, blurred(rig.tip(dot)), noise_px, noise_px});
    const auto ours = solve_rig(seen);
    ASSERT_TRUE(ours.ok()) << ours.error().message;
    const auto thesis = ThesisTouchModel::solve(rig.screen, measured(rig, dots[0], seen.touches[0].image),
                                                measured(rig, dots[1], seen.touches[1].image));
    ASSERT_TRUE(thesis.ok()) << thesis.error().message;
    for (int i = 0; i < 20; ++i) {
      const ScreenPoint place{random_.between(0.1, 0.9) * rig.screen.width_mm,
                              random_.between(0.4, 1) * rig.screen.height_mm};
      if (!rig.sees_tip(place)) continue;
      const ImagePoint tip = blurred(rig.tip(place));
      const MeasuredTouch touch = measured(rig, place, tip);
      const auto by_thesis = thesis->screen_point(touch.length_px, touch.column_px);
      const auto by_ours = ours->model.screen_point(tip);
      ASSERT_TRUE(by_thesis && by_ours);
      sum(thesis_sum_, place, *by_thesis);
      sum(ours_sum_, place, *by_ours);
      ++count_;
    }
  }

  [[nodiscard]] MeanError ours() const { return mean(ours_sum_); }
  [[nodiscard]] MeanError thesis() const { return mean(thesis_sum_); }
  [[nodiscard]] int count() const { return count_; }
  RandomRigs& random() { return random_; }

 private:
  ImagePoint blurred(const ImagePoint& p) {
    return {p.u_px + random_.normal(noise_px), p.v_px + random_.normal(noise_px)};
  }
  static MeasuredTouch measured(const KnownRig& rig, const ScreenPoint& place, const ImagePoint& tip) {
    const double border = border_row(rig.model.camera, rig.screen.height_mm, tip.u_px).value();
    return {place, tip.v_px - border, tip.u_px - 0.5 * (rig.model.camera.image().width_px - 1)};
  }
  static void sum(MeanError& sum, const ScreenPoint& truth, const ScreenPoint& found) {
    sum.vertical_mm += std::abs(found.y_mm - truth.y_mm);
    sum.horizontal_mm += std::abs(found.x_mm - truth.x_mm);
  }
  [[nodiscard]] MeanError mean(const MeanError& sum) const {
    return {sum.vertical_mm / count_, sum.horizontal_mm / count_};
  }

  RandomRigs random_;
  MeanError thesis_sum_;
  MeanError ours_sum_;
  int count_ = 0;
};

void record(const TwoTouches& found) {
  const auto tell = [](const char* name, double mm) { testing::Test::RecordProperty(name, std::to_string(mm)); };
  tell("default_vertical_mm", found.ours().vertical_mm);
  tell("default_horizontal_mm", found.ours().horizontal_mm);
  tell("thesis_vertical_mm", found.thesis().vertical_mm);
  tell("thesis_horizontal_mm", found.thesis().horizontal_mm);
}

// A camera without angles and distortion is the thesis' model itself, which then has fewer parameters to learn.
TEST(TwoTouchCalibration, IsAboutAsExactOnTheVirtualRigAsTheModelMadeForIt) {
  TwoTouches found(21);
  const KnownRig virtual_rig{{380, 300, 1280, 1024}, {RigCamera({1100, 0, {190, -15, 50}}, {1280, 720}), 5.5}};
  for (int i = 0; i < 60; ++i)
    found.add(virtual_rig);
  record(found);
  EXPECT_GT(found.count(), 500);
  EXPECT_LT(found.ours().vertical_mm, 1);
  EXPECT_LT(found.ours().horizontal_mm, 1);
  EXPECT_LT(found.ours().vertical_mm, 1.25 * found.thesis().vertical_mm);
  EXPECT_LT(found.ours().horizontal_mm, 1.25 * found.thesis().horizontal_mm);
}

TEST(TwoTouchCalibration, IsMoreExactThanTheThesisWithTiltsAndLenses) {
  TwoTouches found(22);
  for (int i = 0; i < 100; ++i)
    found.add(found.random().usual_rig());
  record(found);
  EXPECT_GT(found.count(), 500);
  EXPECT_LT(found.ours().vertical_mm, 0.6 * found.thesis().vertical_mm);
  EXPECT_LT(found.ours().horizontal_mm, 0.3 * found.thesis().horizontal_mm);
}

}  // namespace
}  // namespace telehug
