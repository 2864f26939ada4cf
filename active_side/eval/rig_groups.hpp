// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "capture/virtual_rig/random_rig.hpp"
#include "eval/touch_score.hpp"

namespace telehug {

// What a virtual rig has in common with others: bezel, light, coat, desk, how far its camera is turned (altogether, so
// 0 to 7 degrees), which way its lens bends.
[[nodiscard]] std::vector<std::string> groups_of(const RandomRig& rig);

// Which of the false touches a frame without a touch belongs to: "no hand", "away", "hover < 10 mm", and, since only a
// mirror image tells that they hover, "hover >= 10 mm, glossy, mirrored" where it can be seen and "hover >= 10 mm,
// glossy" where the screen is too bright, and so on.
[[nodiscard]] std::string rest_group(const ScoredRest& rest, const std::string& coat);

}  // namespace telehug
