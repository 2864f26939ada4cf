// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "peer/path_delay.hpp"

namespace telehug {

inline constexpr Duration default_stale_age = 150ms;

// Which touches are too old to be felt, by their age above the smallest delay seen.
class Staleness {
 public:
  explicit Staleness(Duration stale_age = default_stale_age) : stale_age_(stale_age) {}

  // Anything else that the sender of touches stamps, so that the smallest delay is known before the first touch.
  Duration observe(const SessionId& session, std::int64_t sent_time_ns, Timestamp now) {
    return path_.observe(session, sent_time_ns, now);
  }

  // Counted if it is too old to be felt.
  bool is_stale(const TouchEvent& event, Timestamp now) {
    touch_age_ = path_.observe(event.session, event.sent_time_ns, now);
    const bool stale = touch_age_ > stale_age_;
    if (stale) ++stale_count_;
    return stale;
  }

  [[nodiscard]] std::uint64_t stale_count() const noexcept { return stale_count_; }
  // Of the newest touch.
  [[nodiscard]] Duration touch_age() const noexcept { return touch_age_; }

 private:
  Duration stale_age_;
  PathDelay path_;
  std::uint64_t stale_count_ = 0;
  Duration touch_age_{};
};

}  // namespace telehug
