// SPDX-License-Identifier: Apache-2.0
#include "service/notifier.hpp"

#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace telehug {
namespace {

// Longer than a participant takes to be made anew, or a disk to write.
constexpr Duration longest_housekeeping = 60s;

// A failure to tell systemd leaves nothing to do that would help: the watchdog is there for that case.
void tell(const std::string& state) {
  (void)sd_notify(0, state.c_str());
}

}  // namespace

Notifier::Notifier() {
  std::uint64_t interval_us = 0;
  if (sd_watchdog_enabled(0, &interval_us) > 0) {
    watchdog_ = std::chrono::microseconds(static_cast<std::int64_t>(interval_us));
  }
}

void Notifier::ready() const {
  tell("READY=1");
}

void Notifier::reloading(Timestamp now) const {
  tell("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(to_ns(now) / 1000));
}

void Notifier::status(std::string_view sentence) const {
  std::string line(sentence);
  // A line break would begin another assignment.
  std::replace(line.begin(), line.end(), '\n', ' ');
  tell("STATUS=" + line);
}

void Notifier::stopping() const {
  tell("STOPPING=1");
}

void Notifier::alive(Timestamp now) {
  if (first_alive_ns_ == 0) first_alive_ns_ = to_ns(now);
  const Timestamp house_kept = from_ns(std::max(house_kept_ns_.load(), first_alive_ns_));
  if (now - house_kept >= longest_housekeeping) return;
  if (!watchdog_ || (last_told_ != Timestamp{} && now - last_told_ < *watchdog_ / 2)) return;
  last_told_ = now;
  tell("WATCHDOG=1");
}

}  // namespace telehug
