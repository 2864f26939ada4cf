// SPDX-License-Identifier: Apache-2.0
//
// The sequences of the two rigs of the touch samples (ray-traced: approach, touch from frame 7 on, slide, release after
// frame 16), as a finger detector and a solved camera see them: tips and finger widths in pixels. In the other frames
// no finger crosses the border. No mirror evidence: it is decided by motion and width alone.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "touch/contact_tracker.hpp"

namespace telehug {
namespace {

struct Sight {
  int frame;
  double u_px, v_px, width_px;
};

struct Sequence {
  const char* name;
  RigCameraParameters camera;
  ScreenSize screen;
  std::vector<Sight> sights;
};

const std::vector<Sequence>& sequences() {
  static const std::vector<Sequence> all{{"Rig1",
                                          {1066.86, -0.0360, {198.07, -5.85, 43.78}, 0.692, 0.923, 0.553},
                                          {380, 300, 1280, 1024},
                                          {{6, 746.954, 506.838, 28.8},
                                           {7, 747.041, 534.532, 44.0},
                                           {8, 753.247, 534.954, 42.4},
                                           {9, 762.190, 535.014, 45.0},
                                           {10, 778.757, 535.809, 44.4},
                                           {11, 799.692, 536.672, 47.4},
                                           {12, 822.386, 537.648, 54.0},
                                           {13, 843.451, 538.735, 45.6},
                                           {14, 861.617, 539.844, 48.8},
                                           {15, 873.387, 539.896, 49.0},
                                           {16, 877.881, 540.521, 46.2}}},
                                         {"Rig2",
                                          {987.38, 0.0368, {189.46, 5.83, 52.06}, -1.297, -0.894, -1.183},
                                          {408, 255, 1440, 900},
                                          {{6, 229.258, 606.064, 78.0},
                                           {7, 223.795, 652.505, 79.6},
                                           {8, 239.279, 650.379, 88.0},
                                           {9, 301.384, 648.053, 84.6},
                                           {10, 389.303, 636.083, 79.6},
                                           {11, 486.133, 623.167, 76.0},
                                           {12, 575.740, 611.797, 70.0},
                                           {13, 660.168, 600.828, 62.8},
                                           {14, 731.145, 592.153, 62.2},
                                           {15, 775.759, 586.941, 61.0},
                                           {16, 791.887, 585.362, 58.4},
                                           {17, 789.907, 533.981, 43.2}}}};
  return all;
}

class SampleSequence : public testing::TestWithParam<Sequence> {};

std::string sequence_name(const testing::TestParamInfo<Sequence>& sequence) {
  return sequence.param.name;
}

INSTANTIATE_TEST_SUITE_P(Of, SampleSequence, testing::ValuesIn(sequences()), sequence_name);

TEST_P(SampleSequence, IsOneContactThatBeginsAndEndsWithinAFrameOfTheTruth) {
  const Sequence& sequence = GetParam();
  const RigCamera camera(sequence.camera, {1280, 720});
  TrackerOptions options;
  options.camera = camera_foot(camera, sequence.screen);
  ContactTracker tracker(options);
  std::vector<int> downs, ups;
  std::vector<int> taken_for_touches;
  for (int frame = 1; frame <= 22; ++frame) {
    FingerObservations fingers;
    for (const Sight& sight : sequence.sights) {
      if (sight.frame != frame) continue;
      const ScreenPoint at = camera.screen_point({sight.u_px, sight.v_px}).value();
      const double px_per_mm = camera.parameters().focal_px / (at.y_mm - options.camera.foot.y_mm);
      fingers.push_back({at, sight.width_px / px_per_mm, px_per_mm, {}, 1});
    }
    const auto time = Timestamp{1s} + frame * std::chrono::microseconds{33'333};
    for (const ContactState& state : tracker.update(fingers, time)) {
      if (state.phase == Phase::down) downs.push_back(frame);
      if (state.phase == Phase::up) ups.push_back(frame);
      if (state.phase != Phase::up && state.touching >= 0.5) taken_for_touches.push_back(frame);
    }
  }
  ASSERT_EQ(downs.size(), 1U);
  ASSERT_EQ(ups.size(), 1U);
  EXPECT_NEAR(downs[0], 7, 1);
  EXPECT_NEAR(ups[0], 17, 1);
  // From frame 17 on it hovers at 10 mm and more.
  EXPECT_LE(taken_for_touches.back(), 16);
  EXPECT_GE(taken_for_touches.size(), 9U);
}

}  // namespace
}  // namespace telehug
