// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace telehug {

// Hue as OpenCV gives it for bytes, unrounded: 0..180, half degrees; 0 for greys.
[[nodiscard]] float hue_180(float blue, float green, float red) noexcept;

// A colour and the thesis' limits around it within which a pixel is taken for finger.
class FingerColour {
 public:
  static constexpr float red_limit = 50;
  static constexpr float green_limit = 70;
  static constexpr float blue_limit = 70;
  static constexpr float hue_limit = 25;  // circular

  FingerColour(float blue, float green, float red) noexcept
      : blue_(blue), green_(green), red_(red), hue_(hue_180(blue, green, red)) {}

  // `bgr` points to three bytes.
  [[nodiscard]] bool accepts(const std::uint8_t* bgr) const noexcept;

 private:
  float blue_;
  float green_;
  float red_;
  float hue_;
};

}  // namespace telehug
