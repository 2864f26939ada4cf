// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string_view>

#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// Draws what a screen of that resolution shows (CV_8UC3); the same for the same seed.
cv::Mat draw_screen_content(ScreenContent content, const ScreenSize& screen, std::uint64_t seed);

// "black", "chat" and so on.
std::string_view name_of(ScreenContent content);

}  // namespace telehug
