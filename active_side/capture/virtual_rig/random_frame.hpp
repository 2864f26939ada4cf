// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "capture/rig_directory.hpp"
#include "capture/virtual_rig/hand_pose.hpp"
#include "capture/virtual_rig/random_rig.hpp"

namespace telehug {

enum class FrameKind { touch, hover, away, nohand, two_fingers, two_hands, palm };

// A single picture: who does what while the screen shows what.
struct RandomFrame {
  FrameKind kind = FrameKind::nohand;
  std::vector<HandPose> hands;  // with their looks
  ScreenContent content = ScreenContent::black;
};

// Hands at places that the camera of `rig` sees, by one of its users (both hands of one for two_hands). `away`: in
// view, but above the screen's lower border in the picture. `palm`: a fist, the edge of a hand or a forearm lies across
// that border, and no finger points. The same for the same seed.
RandomFrame random_frame(const RandomRig& rig, FrameKind kind, std::uint64_t seed);

// A hand of that user that touches (hover_mm 0) or hovers over a point, leaned and bent at random, without reaching
// through the bezel.
HandPose random_pose(const VirtualRigSettings& rig, const HandLooks& looks, const FingerPlace& place,
                     std::uint64_t seed);

// The truth of a picture, a row for each finger that points (one without a hand).
std::vector<TruthRow> truth_of(const RandomFrame& frame, const std::string& name);

// A line of truth.csv, and its header.
std::string csv_line(const TruthRow& row);
inline constexpr std::string_view truth_csv_header = "frame,contact,x_mm,y_mm,hover_mm,hand,tone,screen,notes\n";

std::string_view name_of(FrameKind kind);

}  // namespace telehug
