// SPDX-License-Identifier: Apache-2.0
//
// The 1 Euro filter (Casiez, Roussel, Vogel, CHI 2012) for points: a low pass whose cutoff rises with the speed, so
// that a resting finger does not tremble and a fast one does not lag. Both coordinates share the cutoff, else a
// slanting stroke would bend. Unlike the paper's, the speed comes from the innovation, not from a filtered derivative,
// which would itself lag where a stroke begins.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include "common/units.hpp"

namespace telehug {

struct OneEuroOptions {
  double least_cutoff_hz = 2.5;      // at rest: 30 frames a second and noise of 1 mm leave 0.45 mm
  double cutoff_hz_per_mm_s = 0.06;  // a stroke of 100 mm/s trails by 1 to 2 mm, one of 1 m/s by less than 1 mm
  // Noise looks like motion of this speed times the frame rate: innovations up to here do not open the filter.
  double noise_mm = 1.5;
};

class OneEuroFilter {
 public:
  explicit OneEuroFilter(const OneEuroOptions& options = {}) : options_(options) {}

  void reset() noexcept { smooth_.reset(); }

  // `seconds` since the last point; not positive: the point is taken as it is.
  ScreenPoint update(const ScreenPoint& point, double seconds) noexcept {
    if (!smooth_ || !(seconds > 0)) {
      smooth_ = point;
      return point;
    }
    const double dx = point.x_mm - smooth_->x_mm;
    const double dy = point.y_mm - smooth_->y_mm;
    const double beyond_noise_mm = std::fmax(0, std::hypot(dx, dy) - options_.noise_mm);
    const double cutoff_hz = options_.least_cutoff_hz + options_.cutoff_hz_per_mm_s * beyond_noise_mm / seconds;
    const double tau_s = 1 / (2 * std::numbers::pi * cutoff_hz);
    const double gain = seconds / (seconds + tau_s);
    smooth_->x_mm += gain * dx;
    smooth_->y_mm += gain * dy;
    return *smooth_;
  }

 private:
  OneEuroOptions options_;
  std::optional<ScreenPoint> smooth_;
};

}  // namespace telehug
