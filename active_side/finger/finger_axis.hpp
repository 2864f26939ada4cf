// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "finger/crossing.hpp"

namespace telehug {

// A finger as two straight edges say: a strip about a line that runs down the picture, across the border.
class FingerAxis {
 public:
  FingerAxis(const Crossing& crossing, const BorderCurve& border) {
    for (int i = 0; i < 4; ++i) {
      v_px_ = border.v_at(u_px_);
      u_px_ = 0.5 * (crossing.left.u_at(v_px_) + crossing.right.u_at(v_px_));
    }
    half_width_px_ = std::max(0.5 * (crossing.right.u_at(v_px_) - crossing.left.u_at(v_px_)), least_half_width_px);
    slope_ = 0.5 * (crossing.left.slope + crossing.right.slope);
    taper_ = 0.5 * (crossing.right.slope - crossing.left.slope);
  }

  [[nodiscard]] double border_v_px() const noexcept { return v_px_; }
  [[nodiscard]] double slope() const noexcept { return slope_; }
  [[nodiscard]] double centre_u(double v) const noexcept { return u_px_ + slope_ * (v - v_px_); }
  // Edges that meet or part far from where they were seen are not believed.
  [[nodiscard]] double half_width(double v) const noexcept {
    return std::clamp(half_width_px_ + taper_ * (v - v_px_), 0.7 * half_width_px_, 1.25 * half_width_px_);
  }

 private:
  static constexpr double least_half_width_px = 6;

  double u_px_ = 0;  // of the middle, at the border
  double v_px_ = 0;
  double half_width_px_ = 0;
  double slope_ = 0;
  double taper_ = 0;
};

}  // namespace telehug
