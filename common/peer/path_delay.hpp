// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/clock.hpp"
#include "common/messages.hpp"

namespace telehug {

// How late a message is, although the two PCs' clocks can't be compared.
//
// Each message carries its sender's monotonic time. Arrival minus that time is the way plus the unknown difference of
// the clocks; the smallest value of the last seconds stands for the shortest way, and what a message needed more than
// that is its age. So age leaves out the shortest way itself. (The minimum filter of NTP's clock filter algorithm, RFC
// 5905 section 10, applied one way.) Feed it with everything that the sender stamps, heartbeats too: then the minimum
// is known before the first touch. Allocates only when a new session begins.
class PathDelay {
 public:
  // The minimum is taken over this time, so after it a lasting change of the way or of the sender's clock (it slept) is
  // believed.
  static constexpr Duration window = 10s;
  // Two PCs' quartz clocks drift apart by at most this: by so much an old minimum is let rise over a time without
  // messages.
  static constexpr std::int64_t max_drift_per_million = 200;

  // The age of a message that arrives now, >= 0. sent_time_ns: as the sender stamped it, >= 0. A new session begins
  // anew with age 0 (another program, perhaps after a reboot: another clock).
  Duration observe(const SessionId& session, std::int64_t sent_time_ns, Timestamp now);

 private:
  static constexpr std::size_t buckets = 10;
  static constexpr std::int64_t bucket_ns = window / std::chrono::nanoseconds(1) / static_cast<std::int64_t>(buckets);

  void move_window(std::int64_t now_ns);
  [[nodiscard]] std::optional<std::int64_t> smallest() const noexcept;

  SessionId session_;
  std::array<std::optional<std::int64_t>, buckets> smallest_;  // difference in ns, per bucket of arrival time
  std::int64_t newest_bucket_ = 0;
  std::int64_t last_arrival_ns_ = 0;
};

}  // namespace telehug
