// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace telehug {

// From strength (0..1 of what an actuator may do) to the intensity of its motor (0..255 of full power). 0 is off; above
// it strength is spread over what turns the motor and is allowed, so that the weakest touch is felt and the strongest
// stays within the limit. Rounded inwards: no limit is exceeded by rounding.
class IntensityScale {
 public:
  // min, max: 0..1 of full power, finite.
  IntensityScale(double min, double max) noexcept
      : least_(std::max(1, static_cast<int>(std::ceil(min * full - rounding)))),
        most_(static_cast<int>(std::floor(max * full + rounding))) {}

  // 0 if there is no intensity that turns the motor and is allowed, or if strength is not above 0 or is no number.
  [[nodiscard]] std::uint8_t intensity(double strength) const noexcept {
    if (!std::isfinite(strength) || strength <= 0 || most_ < least_) return 0;
    return static_cast<std::uint8_t>(least_ + std::lround(std::min(strength, 1.0) * (most_ - least_)));
  }

 private:
  static constexpr double full = 255;
  static constexpr double rounding = 1e-9;  // 0.8 * 255 is a hair away from 204
  int least_;
  int most_;
};

}  // namespace telehug
