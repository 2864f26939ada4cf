// SPDX-License-Identifier: Apache-2.0
//
// What the wearer wants, and what that permits at a moment. Times are the wall clock's: a pause outlives restarts.
#pragma once

#include <bitset>
#include <chrono>
#include <optional>

#include "common/messages.hpp"
#include "common/quiet_hours.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

using MutedBoxes = std::bitset<largest_box + 1>;  // by number in the standard grid
using MutedActuators = std::bitset<256>;          // by id

struct Pause {
  std::optional<std::chrono::sys_seconds> until;  // empty: until it is ended
  friend bool operator==(const Pause&, const Pause&) = default;
};

struct Consent {
  std::optional<Pause> pause;
  QuietHours quiet_hours;      // the configuration's, which the wearer can't take away
  QuietHours own_quiet_hours;  // the wearer's, beside these
  MutedBoxes muted_boxes;
  MutedActuators muted_actuators;
  double strength = 1;  // above 0, at most 1: of what the limits allow
  friend bool operator==(const Consent&, const Consent&) = default;
};

// What may be felt now.
struct Permission {
  std::optional<FeltOutcome> refusal;  // paused or quiet_hours: nothing at all
  MutedBoxes muted_boxes;
  MutedActuators muted_actuators;
  double strength = 1;  // as in Consent
  friend bool operator==(const Permission&, const Permission&) = default;
};

// `now_min`: local time of day, 0..minutes_of_day - 1. A pause counts before quiet hours.
[[nodiscard]] Permission permission_at(const Consent& consent, std::chrono::sys_seconds now, int now_min);

// The span of quiet hours of either kind that holds this minute and ends last; nothing if none does.
[[nodiscard]] std::optional<QuietSpan> quiet_span_at(const Consent& consent, int now_min);

// By the time zone that libc knows ($TZ, /etc/localtime), with its rules for summer time: in the hour that is skipped
// nothing happens, in the hour that comes twice spans hold twice. tzset() makes it follow a zone that was changed.
[[nodiscard]] int local_minute(std::chrono::sys_seconds time);

}  // namespace telehug
