// SPDX-License-Identifier: Apache-2.0
#include "peer/path_delay.hpp"

#include <algorithm>
#include <limits>

namespace telehug {

Duration PathDelay::observe(const SessionId& session, std::int64_t sent_time_ns, Timestamp now) {
  const std::int64_t now_ns = to_ns(now);
  if (session != session_) {
    session_ = session;
    smallest_.fill(std::nullopt);
    newest_bucket_ = now_ns / bucket_ns;
  }
  move_window(now_ns);
  // The stamp comes from outside: what no clock shows (146 years) must not overflow the differences of differences.
  constexpr std::int64_t max_stamp_ns = std::numeric_limits<std::int64_t>::max() / 2;
  const std::int64_t difference_ns = now_ns - std::clamp<std::int64_t>(sent_time_ns, 0, max_stamp_ns);
  auto& bucket = smallest_[static_cast<std::size_t>(newest_bucket_) % buckets];
  bucket = std::min(bucket.value_or(difference_ns), difference_ns);
  last_arrival_ns_ = now_ns;
  return std::chrono::nanoseconds(difference_ns - *smallest());
}

void PathDelay::move_window(std::int64_t now_ns) {
  const std::int64_t bucket = now_ns / bucket_ns;
  const auto before = smallest();
  const std::int64_t steps = std::min(bucket - newest_bucket_, static_cast<std::int64_t>(buckets));
  for (std::int64_t i = 0; i < steps; ++i)
    smallest_[static_cast<std::size_t>(bucket - i) % buckets].reset();
  newest_bucket_ = std::max(newest_bucket_, bucket);
  if (before && !smallest()) {
    // Nothing came for a whole window: what was known still holds, but for the drift of the clocks. Forgetting it would
    // make the first message after a long stall, and all that were stuck with it, look fresh.
    const std::int64_t silence_ns = now_ns - last_arrival_ns_;
    smallest_[static_cast<std::size_t>(newest_bucket_) % buckets] =
        *before + silence_ns / 1'000'000 * max_drift_per_million;
  }
}

std::optional<std::int64_t> PathDelay::smallest() const noexcept {
  std::optional<std::int64_t> least;
  for (const auto& bucket : smallest_) {
    if (bucket) least = std::min(least.value_or(*bucket), *bucket);
  }
  return least;
}

}  // namespace telehug
