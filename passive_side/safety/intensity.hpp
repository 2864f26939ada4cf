// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "link/protocol.hpp"

namespace telehug {

// From strength (0..1 of what an actuator may do) to the intensity of its motor (0..255 of full power). 0 is off; above
// it strength is spread over what turns the motor and is allowed, so that the weakest touch is felt and the strongest
// stays within the limit.
//
// The microcontroller rounds an intensity to the nearest of its steps. So that this never exceeds a limit, only steps
// between the limits are chosen here, and each is given as the intensity that the microcontroller rounds back to it.
class IntensityScale {
 public:
  // min, max: 0..1 of full power, finite.
  IntensityScale(double min, double max) noexcept
      : least_step_(std::max(1, static_cast<int>(std::ceil(min * steps - rounding)))),
        most_step_(static_cast<int>(std::floor(max * steps + rounding))) {}

  // 0 if no step turns the motor and is allowed, or if strength is not above 0 or is no number.
  [[nodiscard]] std::uint8_t intensity(double strength) const noexcept {
    if (!std::isfinite(strength) || strength <= 0 || most_step_ < least_step_) return 0;
    return of_step(least_step_ + std::lround(std::min(strength, 1.0) * (most_step_ - least_step_)));
  }

  // The strongest of those intensities that is not above this power (0..1 of full); 0 if none turns the motor.
  [[nodiscard]] std::uint8_t at_most(double power) const noexcept {
    if (!(power > 0)) return 0;  // or is no number
    const auto step = std::min<long>(most_step_, std::lround(std::floor(std::min(power, 1.0) * steps + rounding)));
    return step < least_step_ ? std::uint8_t{0} : of_step(step);
  }

  // The least power that turns the motor.
  [[nodiscard]] double least_power() const noexcept { return static_cast<double>(least_step_) / steps; }

  // What the microcontroller makes of an intensity: 0..1 of full power.
  [[nodiscard]] static double power(std::uint8_t intensity) noexcept {
    return std::round(intensity * steps / full) / steps;
  }

 private:
  [[nodiscard]] static std::uint8_t of_step(long step) noexcept {
    return static_cast<std::uint8_t>(std::lround(static_cast<double>(step) * full / steps));
  }

  static constexpr int steps = protocol::intensity_levels - 1;
  static constexpr double full = 255;
  static constexpr double rounding = 1e-9;  // a limit that is a step stays one: 31 * (24 / 31.0) may be a hair off
  int least_step_;
  int most_step_;
};

}  // namespace telehug
