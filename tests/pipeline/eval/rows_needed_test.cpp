// SPDX-License-Identifier: Apache-2.0
//
// The fingers in a picture are the same whatever stands in the rows that are said not to be needed.
#include "detection/rows_needed.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "capture/virtual_rig/random_frame.hpp"
#include "capture/virtual_rig/random_rig.hpp"
#include "capture/virtual_rig/rig_renderer.hpp"
#include "detection/make_detector.hpp"
#include "doubles/perfect_calibration.hpp"

namespace telehug {
namespace {

TEST(RowsNeeded, AreEnoughForEveryDetector) {
  cv::RNG random(2);
  int fingers_seen = 0;
  for (const std::uint64_t seed : {3U, 6U, 11U, 18U}) {
    const RandomRig rig = random_rig(seed, ImageSize{1280, 720});
    RigRenderer renderer(rig.settings);
    const Calibration calibration = calibration_of(rig.settings);
    const RowRange rows = rows_needed(calibration);
    ASSERT_GT(rows.first, 100);
    ASSERT_EQ(rows.end, 720);
    cv::Mat picture;
    renderer.draw(std::vector<HandPose>{}, 0, picture);
    const BorderStrip::Layout layout = strip_layout(calibration);
    BorderStrip empty(layout);
    empty.sample(picture, layout);
    for (const char* const choice : {"default", "thesis"}) {
      AnyDetector detector = make_detector(choice, calibration, empty);
      for (std::uint64_t frame = 1; frame <= 12; ++frame) {
        renderer.draw(random_frame(rig, FrameKind::touch, frame).hands, frame, picture);
        const Fingers whole = detect(detector, picture);
        cv::Mat others = picture.rowRange(0, rows.first);
        random.fill(others, cv::RNG::UNIFORM, 0, 256);
        const Fingers& some = detect(detector, picture);
        ASSERT_EQ(some.size(), whole.size()) << choice << ", rig " << seed << ", frame " << frame;
        for (std::size_t i = 0; i < whole.size(); ++i) {
          EXPECT_NEAR(some[i].tip.u_px, whole[i].tip.u_px, 0.01) << choice << ", rig " << seed << ", frame " << frame;
          EXPECT_NEAR(some[i].tip.v_px, whole[i].tip.v_px, 0.01) << choice << ", rig " << seed << ", frame " << frame;
        }
        fingers_seen += static_cast<int>(whole.size());
      }
    }
  }
  EXPECT_GT(fingers_seen, 40);
}

TEST(RowsNeeded, LieAtTheOtherEndOfPicturesThatAreUpsideDown) {
  const Calibration calibration = calibration_of(random_rig(11, ImageSize{1280, 720}).settings);
  Calibration turned = calibration;
  auto& camera = std::get<RigCalibration>(turned.solved).solution.model.camera;
  camera =
      RigCamera(camera.parameters(), camera.image(), {.left_right_exchanged = false, .top_bottom_exchanged = true});
  EXPECT_EQ(rows_needed(turned), rows_needed(calibration).flipped(720));
  EXPECT_EQ(rows_needed(turned).first, 0);
}

}  // namespace
}  // namespace telehug
