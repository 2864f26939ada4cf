// SPDX-License-Identifier: Apache-2.0
//
// The touch path of a rig whose camera was solved: it watches the bezel and corrects a camera that turned.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "calibration/rig_solver.hpp"
#include "detection/rows_needed.hpp"
#include "doubles/allocation_counter.hpp"
#include "pipeline/app/active_pipeline_fixture.hpp"

namespace telehug {
namespace {

// A camera without angles 50 mm in front of the screen's upper edge, so that the border is where the scene has it.
class WatchedCamera : public ActivePipelineTest {
 protected:
  static Calibration calibration() {
    const RigModel model{RigCamera({1000, 0, {200, -11.5, 50}}, image), 10};
    RigObservations seen{screen, image, {}, {}, {}};
    for (const ScreenPoint& place : {ScreenPoint{200, 200}, {230, 260}, {120, 230}, {300, 240}, {180, 290}})
      seen.touches.push_back({place, tip_of_contact(model.camera, 10, place).value(), 0.1, 0.1});
    for (int u = 20; u < image.width_px; u += 40)
      seen.border.push_back({{static_cast<double>(u), border.v_at(u)}, 0.1});
    const RigSolution solution = solve_rig(seen).value();
    return {"drawn", "2026-11-22T00:00:00Z", image, screen, border, RigCalibration{seen, solution}};
  }

  WatchedCamera() { see(nobody()); }  // the bezel is learnt
  const TouchEvent* see(const cv::Mat& picture) {
    clock.advance(frame_period);
    map.seen = clock.now();
    frame.bgr = picture;
    frame.time = clock.now() - 5ms;
    return watched.process(frame, map, true);
  }
  static cv::Mat moved(int rows, bool finger) {
    DrawnScene scene({border.v0_px + rows, 0}, image);
    if (finger) scene.finger(613, 55, 57);
    return scene.noise(3, 4).picture();
  }

  static Calibration upside_down_calibration() {
    Calibration turned = calibration();
    auto& camera = std::get<RigCalibration>(turned.solved).solution.model.camera;
    camera = RigCamera(camera.parameters(), image, {.left_right_exchanged = false, .top_bottom_exchanged = true});
    turned.border = border_line(camera, screen);
    return turned;
  }
  ActivePipeline pipeline_of_upside_down_camera() {
    const Calibration turned = upside_down_calibration();
    return pipeline_with(detector_of(turned, "default", nobody()), turned);
  }

  ActivePipeline watched = pipeline_with(detector_of(calibration(), "default", nobody()), calibration());
};

TEST_F(WatchedCamera, SeesTheSameUpsideDown) {
  ActivePipeline upside_down = pipeline_of_upside_down_camera();
  cv::Mat flipped;
  cv::flip(touching(), flipped, 0);
  const ScreenPoint upright = see(touching())->contacts.at(0).screen;
  const TouchEvent* event = see_with(upside_down, flipped);
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->contacts.at(0).screen.x_mm, upright.x_mm);
  EXPECT_EQ(event->contacts.at(0).screen.y_mm, upright.y_mm);
}

TEST_F(WatchedCamera, SeesTheSameInTheRowsThatAreNeeded) {
  ActivePipeline upside_down = pipeline_of_upside_down_camera();
  const ScreenPoint whole = see(touching())->contacts.at(0).screen;
  for (const bool flipped : {false, true}) {
    ActivePipeline& seeing = flipped ? upside_down : watched;
    cv::Mat held = cv::Mat::zeros(image.height_px, image.width_px, CV_8UC3);
    const auto see_rows = [&](const cv::Mat& picture) {
      cv::Mat delivered = picture.clone();
      if (flipped) cv::flip(picture, delivered, 0);
      frame.rows = seeing.rows_needed();
      const RowRange rows = frame.rows.within(image.height_px);
      delivered.rowRange(rows.first, rows.end).copyTo(held.rowRange(rows.first, rows.end));
      map.seen = clock.now();
      return see_with(seeing, held);
    };
    EXPECT_EQ(seeing.rows_needed(), RowRange{}) << "until it is known how good pictures look";
    for (int i = 0; i < 40; ++i)
      see_rows(nobody());
    EXPECT_EQ(seeing.rows_needed(), rows_needed(flipped ? upside_down_calibration() : calibration()));
    EXPECT_EQ(seeing.rows_needed().count(), 416);
    const TouchEvent* event = see_rows(touching());
    ASSERT_NE(event, nullptr);
    ASSERT_EQ(event->contacts.size(), 1U);
    EXPECT_NEAR(event->contacts[0].screen.x_mm, whole.x_mm, 0.5);
    EXPECT_NEAR(event->contacts[0].screen.y_mm, whole.y_mm, 0.5);
  }
}

TEST_F(WatchedCamera, IsTrustedWhileItStands) {
  for (int i = 0; i < 100; ++i)
    EXPECT_NE(see(touching()), nullptr);
  EXPECT_EQ(watched.camera_drift(), DriftState::steady);
}

TEST_F(WatchedCamera, IsCorrectedAfterASmallTurn) {
  const cv::Mat turned = moved(2, true);
  const double before_mm = see(turned)->contacts.at(0).screen.y_mm;
  for (int i = 0; i < 80; ++i)
    see(turned);
  EXPECT_EQ(watched.camera_drift(), DriftState::moved_slightly);
  // Two rows are 2.1 mm where this finger touches; what moved down in the picture looked too far up on the screen.
  EXPECT_NEAR(see(turned)->contacts.at(0).screen.y_mm - before_mm, 2.1, 0.8);
}

TEST_F(WatchedCamera, EndsTouchesWhenItWasMoved) {
  ASSERT_NE(see(touching()), nullptr);
  const cv::Mat away = moved(6, true);
  for (int i = 0; i < 80; ++i)
    see(away);
  EXPECT_EQ(watched.camera_drift(), DriftState::moved);
  EXPECT_EQ(see(away), nullptr);
  EXPECT_EQ(see(touching()), nullptr) << "nobody knows where it looks now";
}

TEST_F(WatchedCamera, AllocatesNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has a heap of its own";
  see(touching());
  const std::uint64_t before = allocation_count();
  for (int i = 0; i < 60; ++i)
    see(touching());
  EXPECT_EQ(allocation_count() - before, 0U);
}

}  // namespace
}  // namespace telehug
