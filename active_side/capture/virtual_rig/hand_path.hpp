// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "capture/virtual_rig/hand_pose.hpp"
#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

// Where a hand is at a time.
struct HandPathPoint {
  double time_s = 0;
  FingerPlace finger;
  std::optional<FingerPlace> second;
};

// Times increase. Between two points the hand moves evenly; before the first and after the last one nobody is there.
using HandPath = std::vector<HandPathPoint>;

inline constexpr double beyond_screen_mm = 300;  // a hand may be so far beside the screen
inline constexpr double highest_hover_mm = 300;

// A file with the columns t_s, x_mm, y_mm, hover_mm (see FingerPlace) and, for two fingers, second_x_mm and
// second_y_mm, which are empty where there is one. The second one hovers as high as the first. The error tells all
// faults with their lines.
[[nodiscard]] Result<HandPath> read_hand_path(const std::filesystem::path& path, const ScreenSize& screen);

[[nodiscard]] std::vector<HandPose> hands_at(const HandPath& path, double time_s);

}  // namespace telehug
