// SPDX-License-Identifier: Apache-2.0
//
// What status, events and logs call the values of messages.hpp.
#pragma once

#include "common/messages.hpp"

namespace telehug {

[[nodiscard]] constexpr const char* name_of(Phase phase) noexcept {
  constexpr const char* names[] = {"down", "move", "up"};
  return names[static_cast<std::size_t>(phase)];
}

[[nodiscard]] constexpr const char* name_of(Gesture gesture) noexcept {
  constexpr const char* names[gesture_count] = {"none", "tap", "hold", "stroke", "pat", "hug"};
  return names[static_cast<std::size_t>(gesture)];
}

[[nodiscard]] constexpr const char* name_of(FeltOutcome outcome) noexcept {
  constexpr const char* names[felt_outcome_count] = {"driven",  "uncovered", "stopped",     "stale", "jacket absent",
                                                     "limited", "paused",    "quiet hours", "muted", "another sender"};
  return names[static_cast<std::size_t>(outcome)];
}

}  // namespace telehug
