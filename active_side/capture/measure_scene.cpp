// SPDX-License-Identifier: Apache-2.0
#include "capture/measure_scene.hpp"

#include <algorithm>
#include <array>

namespace telehug {

std::optional<double> measure_scene(FrameSource& camera, const Objective& objective, Frame& frame) {
  constexpr Duration longest_wait = 500ms;
  constexpr int most_broken = 10;
  std::array<double, 3> scores{};
  int good = -settle_frames;
  for (int broken = 0; broken < most_broken && good < static_cast<int>(scores.size());) {
    const ReadOutcome outcome = camera.read(frame, longest_wait);
    if (outcome == ReadOutcome::broken) {
      ++broken;
      continue;
    }
    if (outcome != ReadOutcome::frame) return std::nullopt;
    if (good >= 0) scores[static_cast<std::size_t>(good)] = objective(frame.bgr);
    ++good;
  }
  if (good < static_cast<int>(scores.size())) return std::nullopt;
  std::ranges::sort(scores);
  return scores[scores.size() / 2];
}

}  // namespace telehug
