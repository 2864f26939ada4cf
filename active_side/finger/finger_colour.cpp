// SPDX-License-Identifier: Apache-2.0
#include "finger/finger_colour.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {

float hue_180(float blue, float green, float red) noexcept {
  const float largest = std::max({blue, green, red});
  const float range = largest - std::min({blue, green, red});
  if (range <= 0) return 0;
  float sixth = 0;  // of the colour circle, 30 half degrees each
  if (largest == red) {
    sixth = (green - blue) / range;
  } else if (largest == green) {
    sixth = 2 + (blue - red) / range;
  } else {
    sixth = 4 + (red - green) / range;
  }
  return sixth < 0 ? 30 * sixth + 180 : 30 * sixth;
}

bool FingerColour::accepts(const std::uint8_t* bgr) const noexcept {
  const auto blue = static_cast<float>(bgr[0]);
  const auto green = static_cast<float>(bgr[1]);
  const auto red = static_cast<float>(bgr[2]);
  if (std::abs(red - red_) > red_limit || std::abs(green - green_) > green_limit ||
      std::abs(blue - blue_) > blue_limit) {
    return false;
  }
  const float apart = std::abs(hue_180(blue, green, red) - hue_);
  return std::min(apart, 180 - apart) <= hue_limit;
}

}  // namespace telehug
