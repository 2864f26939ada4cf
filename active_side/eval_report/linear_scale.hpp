// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace telehug {

// From values to places in a picture.
class LinearScale {
 public:
  // low_value lies at low_px, high_value at high_px; the values must differ.
  LinearScale(double low_value, double high_value, double low_px, double high_px);

  [[nodiscard]] double px(double value) const noexcept { return low_px_ + (value - low_value_) * px_per_value_; }
  // At the nearer end what lies outside.
  [[nodiscard]] double clamped_px(double value) const noexcept;
  [[nodiscard]] bool holds(double value) const noexcept { return value >= low_value_ && value <= high_value_; }

  // Round values (1, 2 or 5 times a power of ten apart) on the scale, rising; about `wanted` of them.
  [[nodiscard]] std::vector<double> ticks(int wanted) const;

 private:
  double low_value_;
  double high_value_;
  double low_px_;
  double px_per_value_;
};

}  // namespace telehug
