// SPDX-License-Identifier: Apache-2.0
#include "touches_today.hpp"

#include <ctime>

#include "config/quiet_hours_text.hpp"
#include "safety/consent.hpp"

namespace telehug {
namespace {

bool same_local_day(std::chrono::sys_seconds a, std::chrono::sys_seconds b) {
  const auto day_of = [](std::chrono::sys_seconds time) {
    const std::time_t seconds = time.time_since_epoch().count();
    std::tm local{};
    localtime_r(&seconds, &local);
    return std::pair(local.tm_year, local.tm_yday);
  };
  return day_of(a) == day_of(b);
}

}  // namespace

void TouchesToday::begin_day(std::chrono::sys_seconds now) const {
  if (same_local_day(since_, now)) return;
  since_ = now;
  whole_day_ = true;
  touches_ = 0;
}

void TouchesToday::add(std::chrono::sys_seconds now) {
  const std::lock_guard lock(mutex_);
  begin_day(now);
  ++touches_;
}

nlohmann::json TouchesToday::json(std::chrono::sys_seconds now) const {
  const std::lock_guard lock(mutex_);
  begin_day(now);
  nlohmann::json answer{{"touches", touches_}};
  if (!whole_day_) answer["since"] = time_of_day_text(local_minute(since_));
  return answer;
}

}  // namespace telehug
