// SPDX-License-Identifier: Apache-2.0
#include "safety/consent.hpp"

#include <ctime>

namespace telehug {
namespace {

// For how many minutes from now on, begin included and end not; 0: it is not quiet.
int minutes_left(const QuietSpan& span, int now_min) {
  const int length = (span.end_min - span.begin_min + minutes_of_day) % minutes_of_day;
  const int passed = (now_min - span.begin_min + minutes_of_day) % minutes_of_day;
  return passed < length ? length - passed : 0;
}

}  // namespace

std::optional<QuietSpan> quiet_span_at(const Consent& consent, int now_min) {
  std::optional<QuietSpan> longest;
  for (const QuietHours* hours : {&consent.quiet_hours, &consent.own_quiet_hours}) {
    for (const QuietSpan& span : *hours) {
      const int left = minutes_left(span, now_min);
      if (left > 0 && (!longest || left > minutes_left(*longest, now_min))) longest = span;
    }
  }
  return longest;
}

Permission permission_at(const Consent& consent, std::chrono::sys_seconds now, int now_min) {
  Permission permission{{}, consent.muted_boxes, consent.muted_actuators, consent.strength};
  if (consent.pause && (!consent.pause->until || now < *consent.pause->until)) {
    permission.refusal = FeltOutcome::paused;
  } else if (quiet_span_at(consent, now_min)) {
    permission.refusal = FeltOutcome::quiet_hours;
  }
  return permission;
}

int local_minute(std::chrono::sys_seconds time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm local{};
  if (localtime_r(&seconds, &local) == nullptr) return 0;  // beyond the year 2^31
  return local.tm_hour * 60 + local.tm_min;
}

}  // namespace telehug
