// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>

#include <optional>
#include <string>

#include "common/clock.hpp"
#include "safety/safety_values.hpp"

namespace telehug {

// What the log is told of the budgets: at most once a minute, however often they weaken something.
class LimitNotes {
 public:
  static constexpr Duration apart = std::chrono::minutes(1);

  // The note to log now, if there is any.
  [[nodiscard]] std::optional<std::string> next(const SafetyCounters& counters, Timestamp now) {
    if (noted_ && now - *noted_ < apart) return std::nullopt;
    std::string note;
    const auto add = [&note](std::uint64_t more, const char* why) {
      if (more > 0) note += fmt::format("{}{} commands {}", note.empty() ? "limited: " : "; ", more, why);
    };
    add(counters.limited_by_duty - told_.limited_by_duty, "to motors that have run for most of the time (max_duty)");
    add(counters.limited_by_current - told_.limited_by_current,
        "to more motors at once than their supply can turn (supply_ma)");
    add(counters.limited_by_heater - told_.limited_by_heater, "to heaters that must not heat (see `telehug status`)");
    if (note.empty()) return std::nullopt;
    noted_ = now;
    told_ = counters;
    return note;
  }

 private:
  std::optional<Timestamp> noted_;
  SafetyCounters told_;
};

}  // namespace telehug
