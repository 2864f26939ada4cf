// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "common/clock.hpp"

namespace telehug {

// Was this PC suspended? CLOCK_BOOTTIME goes on meanwhile, CLOCK_MONOTONIC does not.
class SuspendDetector {
 public:
  // Shorter is taken for the moment that lies between reading the two clocks.
  explicit SuspendDetector(Duration shortest = 500ms) : shortest_(shortest) {}

  // True once after each time. `since_boot` as read together with `now`.
  [[nodiscard]] bool resumed(Timestamp now, Duration since_boot) noexcept;

 private:
  Duration shortest_;
  std::optional<Duration> asleep_;  // in all
};

// By CLOCK_BOOTTIME.
[[nodiscard]] Duration time_since_boot() noexcept;

}  // namespace telehug
