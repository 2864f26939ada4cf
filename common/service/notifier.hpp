// SPDX-License-Identifier: Apache-2.0
//
// What a daemon tells systemd of itself (sd_notify(3)). Without systemd every call does nothing.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string_view>

#include "common/clock.hpp"

namespace telehug {

class Notifier {
 public:
  // Reads how often systemd wants to hear from this process ($WATCHDOG_USEC).
  Notifier();

  // Again after reloading().
  void ready() const;
  // What `systemctl reload` waits for to be over; also as Type=notify-reload wants it.
  void reloading(Timestamp now) const;
  void status(std::string_view sentence) const;  // shown by `systemctl status`
  void stopping() const;

  // Call it whenever the pipeline has made a round, as often as you like; systemd is told at half its interval. Not
  // from a timer of its own: then a stuck pipeline would look alive. Nothing is told while housekeeping hangs.
  void alive(Timestamp now);

  // From another thread: housekeeping has made a round. It may take its time, but not more than a minute.
  void keeps_house(Timestamp now) noexcept { house_kept_ns_ = to_ns(now); }

  [[nodiscard]] std::optional<Duration> watchdog_interval() const noexcept { return watchdog_; }

 private:
  std::optional<Duration> watchdog_;
  Timestamp last_told_{};
  std::atomic<std::int64_t> house_kept_ns_ = 0;  // 0: not yet
  std::int64_t first_alive_ns_ = 0;              // then housekeeping has begun, too
};

}  // namespace telehug
