// SPDX-License-Identifier: Apache-2.0
//
// The one way in which telehug reads the time. All times on one PC are CLOCK_MONOTONIC (what V4L2 stamps frames with);
// they mean nothing on another PC (see messages.hpp for what travels).
#pragma once

#include <chrono>
#include <cstdint>

namespace telehug {

using Timestamp = std::chrono::steady_clock::time_point;
using Duration = std::chrono::steady_clock::duration;
using namespace std::chrono_literals;

class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual Timestamp now() const noexcept = 0;
};

class SteadyClock final : public Clock {
 public:
  [[nodiscard]] Timestamp now() const noexcept override { return std::chrono::steady_clock::now(); }
};

// Nanoseconds since the PC started: the form in which a time is written to files and to the wire.
[[nodiscard]] constexpr std::int64_t to_ns(Timestamp time) noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}
[[nodiscard]] constexpr Timestamp from_ns(std::int64_t ns) noexcept {
  return Timestamp{std::chrono::duration_cast<Duration>(std::chrono::nanoseconds{ns})};
}
[[nodiscard]] constexpr double to_ms(Duration duration) noexcept {
  return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace telehug
