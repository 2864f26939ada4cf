// SPDX-License-Identifier: Apache-2.0
#include "network/suspend_detector.hpp"

#include <ctime>

namespace telehug {

bool SuspendDetector::resumed(Timestamp now, Duration since_boot) noexcept {
  const Duration asleep = since_boot - now.time_since_epoch();
  const bool slept = asleep_ && asleep - *asleep_ >= shortest_;
  // Kept otherwise, so that what the reading adds up to by chance does not hide a short sleep.
  if (!asleep_ || slept) asleep_ = asleep;
  return slept;
}

Duration time_since_boot() noexcept {
  timespec time{};
  clock_gettime(CLOCK_BOOTTIME, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace telehug
