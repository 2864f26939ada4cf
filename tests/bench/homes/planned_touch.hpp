// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "publish/touch_event_builder.hpp"

namespace telehug {

inline constexpr std::uint64_t tap_frames = 48;  // from one tap to the next; the finger rests for half of them
inline constexpr GridShape planned_grid{.columns = 5, .rows = 4};

// Whether the event of that number is the first to tell a down or an up (but for the down of the finger that strokes).
[[nodiscard]] inline bool planned_transition(std::uint64_t sequence) {
  return (sequence - 1) % (tap_frames / 2) == 0;
}

// One finger strokes for ever, another taps. The event of that number tells it.
[[nodiscard]] inline BoxedContacts planned_touch(std::uint64_t sequence) {
  const std::uint64_t frame = sequence - 1;
  const double turn = 0.05 * static_cast<double>(frame);
  BoxedContacts contacts;
  contacts.push_back({.id = 1,
                      .phase = frame == 0 ? Phase::down : Phase::move,
                      .screen = {.x_mm = 210 + 30 * std::cos(turn), .y_mm = 180 + 30 * std::sin(turn)},
                      .speed_mm_s = 180,
                      .grid = planned_grid,
                      .box = 7,
                      .body = {.x_fh = 0.1 * std::cos(turn), .y_fh = 0.5},
                      .gesture = Gesture::stroke});
  const std::uint64_t place = frame % tap_frames;
  if (place > tap_frames / 2) return contacts;
  contacts.push_back({.id = static_cast<std::uint32_t>(2 + frame / tap_frames),
                      .phase = place == 0 ? Phase::down : (place == tap_frames / 2 ? Phase::up : Phase::move),
                      .screen = {.x_mm = 120, .y_mm = 90},
                      .speed_mm_s = 0,
                      .grid = planned_grid,
                      .box = 2,
                      .body = {.x_fh = -0.25, .y_fh = 0.25},
                      .gesture = place == tap_frames / 2 ? Gesture::tap : Gesture::none});
  return contacts;
}

}  // namespace telehug
