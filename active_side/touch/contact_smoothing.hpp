// SPDX-License-Identifier: Apache-2.0
//
// A resting finger must not tremble, a stroking one must not lag. The 1 Euro filter (Casiez, Roussel, Vogel, CHI 2012)
// is a low pass whose cutoff rises with the filtered speed; in strokes of 0.2 to 1 m/s it trails by 2 to 5 mm with
// cutoffs that calm a resting finger. This one weighs the step against the noise instead: a low pass for steps that
// noise may explain, none for those that it can't. Both coordinates share the gain, else a slanting stroke would bend.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include "common/units.hpp"

namespace telehug {

struct ContactSmoothingOptions {
  double cutoff_hz = 2.5;  // at rest
  // A point that is clearly farther than this from the smooth one is no noise, whose standard deviation on the screen
  // is 0.5 to 1 mm.
  double noise_mm = 2.5;
};

class ContactSmoothing {
 public:
  explicit ContactSmoothing(const ContactSmoothingOptions& options = {}) : options_(options) {}

  void reset() noexcept { smooth_.reset(); }

  // `seconds` since the last point; not positive: the point is taken as it is.
  ScreenPoint update(const ScreenPoint& point, double seconds) noexcept {
    if (!smooth_ || !(seconds > 0)) {
      smooth_ = point;
      return point;
    }
    const double dx = point.x_mm - smooth_->x_mm;
    const double dy = point.y_mm - smooth_->y_mm;
    const double tau_s = 1 / (2 * std::numbers::pi * options_.cutoff_hz);
    const double low_pass = seconds / (seconds + tau_s);
    const double noise = std::exp(-(dx * dx + dy * dy) / (options_.noise_mm * options_.noise_mm));
    const double gain = 1 - noise * (1 - low_pass);
    smooth_->x_mm += gain * dx;
    smooth_->y_mm += gain * dy;
    return *smooth_;
  }

 private:
  ContactSmoothingOptions options_;
  std::optional<ScreenPoint> smooth_;
};

}  // namespace telehug
