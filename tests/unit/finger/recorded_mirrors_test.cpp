// SPDX-License-Identifier: Apache-2.0
//
// Recorded fingers with the outlines that a detector found.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "finger/mirror_evidence.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

struct Recorded {
  std::string name;
  MirrorState state;
  double hover_mm;
  ScreenNormal normal;
  ImagePoint tip;
  double reference_v_px;
  double centre_u_px;
  double centre_slope;
  double half_width_px;
  double left_u_px;  // of the finger's end
  double right_u_px;
};

class RecordedMirrors : public testing::TestWithParam<Recorded> {};

TEST_P(RecordedMirrors, TellWhatTheFingerDoes) {
  const Recorded& recorded = GetParam();
  const auto picture = read_picture(std::filesystem::path(TELEHUG_FIXTURES) / "mirror" / (recorded.name + ".jpg"));
  ASSERT_TRUE(picture.ok());
  FingerOutline finger;
  finger.tip = recorded.tip;
  finger.reference_v_px = recorded.reference_v_px;
  finger.centre_u_px = recorded.centre_u_px;
  finger.centre_slope = recorded.centre_slope;
  finger.half_width_px = recorded.half_width_px;
  finger.contour = {{recorded.left_u_px, recorded.tip.v_px - 10}, {recorded.right_u_px, recorded.tip.v_px - 10}};
  const MirrorEvidence evidence = mirror_evidence(*picture, finger, recorded.normal);
  EXPECT_EQ(evidence.state, recorded.state);
  if (recorded.state == MirrorState::hovering) {
    EXPECT_NEAR(evidence.gap_mm, recorded.hover_mm, 1.5);
  }
}

INSTANTIATE_TEST_SUITE_P(Rigs, RecordedMirrors,
                         testing::Values(Recorded{"white_screen_touched",
                                                  MirrorState::touching,
                                                  0.0,
                                                  {-0.0099, 4.94},
                                                  {149.6, 40.8},
                                                  -26.9,
                                                  153.2,
                                                  -0.007,
                                                  37.5,
                                                  116.9,
                                                  185.7},
                                         Recorded{"chat_hovered_by_dark_finger",
                                                  MirrorState::hovering,
                                                  11.4,
                                                  {-0.0090, 4.23},
                                                  {51.4, 40.3},
                                                  54.9,
                                                  48.8,
                                                  -0.059,
                                                  13.0,
                                                  29.5,
                                                  73.3},
                                         Recorded{"black_screen_touched",
                                                  MirrorState::touching,
                                                  0.0,
                                                  {-0.0102, 4.31},
                                                  {137.8, 40.1},
                                                  0.4,
                                                  134.4,
                                                  0.250,
                                                  34.4,
                                                  100.8,
                                                  168.6},
                                         Recorded{"chat_touched_with_polish",
                                                  MirrorState::touching,
                                                  0.0,
                                                  {-0.0094, 3.68},
                                                  {82.4, 40.6},
                                                  29.8,
                                                  80.4,
                                                  -0.079,
                                                  20.6,
                                                  60.5,
                                                  103.0},
                                         Recorded{"satin_white_touched",
                                                  MirrorState::unknown,
                                                  0.0,
                                                  {0.0242, 4.33},
                                                  {130.5, 40.8},
                                                  20.6,
                                                  129.7,
                                                  -0.099,
                                                  32.6,
                                                  97.4,
                                                  164.6},
                                         Recorded{"satin_chat_touched",
                                                  MirrorState::touching,
                                                  0.0,
                                                  {0.0213, 5.19},
                                                  {141.1, 40.4},
                                                  -25.0,
                                                  136.5,
                                                  -0.043,
                                                  35.3,
                                                  106.9,
                                                  171.0}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace telehug
