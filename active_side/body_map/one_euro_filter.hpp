// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace telehug {

struct OneEuroOptions {
  double min_cutoff_hz = 0.3;  // at rest
  double beta = 3;             // how much the cutoff rises with the speed
  double speed_cutoff_hz = 1;
};

// The 1 Euro filter (Casiez, Roussel, Vogel, CHI 2012): a low pass whose cutoff rises with the speed, so that what
// rests does not tremble and what moves does not lag.
class OneEuroFilter {
 public:
  explicit OneEuroFilter(const OneEuroOptions& options = {}) : options_(options) {}

  void reset(double value) noexcept {
    value_ = value;
    speed_ = 0;
  }

  // `seconds` since the last value, above 0; speeds count in `unit` a second.
  double update(double value, double seconds, double unit = 1) noexcept {
    const double speed = (value - value_) / seconds / unit;
    speed_ += gain(options_.speed_cutoff_hz, seconds) * (speed - speed_);
    value_ += gain(options_.min_cutoff_hz + options_.beta * std::abs(speed_), seconds) * (value - value_);
    return value_;
  }

  [[nodiscard]] double value() const noexcept { return value_; }

 private:
  static double gain(double cutoff_hz, double seconds) noexcept {
    const double tau_s = 1 / (2 * std::numbers::pi * cutoff_hz);
    return seconds / (seconds + tau_s);
  }

  OneEuroOptions options_;
  double value_ = 0;
  double speed_ = 0;
};

}  // namespace telehug
