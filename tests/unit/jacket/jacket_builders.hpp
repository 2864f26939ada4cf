// SPDX-License-Identifier: Apache-2.0
// Short ways to say what a test of the jacket is about.
#pragma once

#include <vector>

#include "common/messages.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

inline Actuator motor(std::uint8_t id, BodyPoint place, std::vector<std::uint16_t> boxes) {
  Actuator made;
  made.id = id;
  made.name = "motor";
  made.channel = static_cast<std::uint8_t>(id - 1);
  made.place = place;
  made.boxes = std::move(boxes);
  return made;
}

inline JacketProfile profile_of(std::vector<Actuator> actuators, Uncovered uncovered = Uncovered::none) {
  JacketProfile made;
  made.name = "test";
  made.baud = 57600;
  made.uncovered = uncovered;
  made.actuators = std::move(actuators);
  return made;
}

// Middle of a box of the standard grid.
inline BodyPoint middle_of(int box) {
  const int row = (box - 1) / 5;
  return {((box - 1) % 5 - 2) * 0.5, row * 0.5 + 0.25};
}

inline Contact contact_in(int box, std::uint32_t id = 1, Phase phase = Phase::down) {
  Contact made;
  made.id = id;
  made.phase = phase;
  made.box = static_cast<std::uint16_t>(box);
  made.grid = {5, 4};
  made.body = middle_of(box);
  return made;
}

inline TouchEvent event_of(std::uint64_t sequence, const std::vector<Contact>& contacts) {
  TouchEvent made;
  made.sequence = sequence;
  made.frame_time_ns = 1'000'000'000 + static_cast<std::int64_t>(sequence) * 33'000'000;
  made.contacts.assign(contacts.begin(), contacts.end());
  return made;
}

// `contact` as it was new in event `sequence`.
inline Transition transition_of(std::uint64_t sequence, const Contact& contact) {
  return {sequence, 1'000'000'000 + static_cast<std::int64_t>(sequence) * 33'000'000, contact};
}

}  // namespace telehug
