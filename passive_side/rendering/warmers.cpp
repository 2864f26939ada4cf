// SPDX-License-Identifier: Apache-2.0
#include "rendering/warmers.hpp"

#include <algorithm>

#include "rendering/box_table.hpp"
#include "rendering/geometry.hpp"

namespace telehug {
namespace {

// A hand's width: nearer than that all of its warmth comes, and none from twice as far.
constexpr double hand_fh = 0.5;

double nearness(const Contact& contact, const Actuator& heater) {
  const bool reached = heater.side == BodySide::front || contact.gesture == Gesture::hug;
  if (!reached || !finite(contact.body)) return 0;
  return std::clamp(2 - distance_fh(contact.body, heater.place) / hand_fh, 0.0, 1.0);
}

}  // namespace

Spot heaters_near(const Contact& contact, const JacketProfile& profile) {
  Spot spot;
  const int box = standard_box(contact);
  for (std::size_t index = 0; index < std::min(profile.actuators.size(), max_actuators); ++index) {
    const Actuator& actuator = profile.actuators[index];
    if (!actuator.enabled || actuator.kind != ActuatorKind::heater) continue;
    const bool serves = std::ranges::find(actuator.boxes, box) != actuator.boxes.end();
    const double part = profile.rendering == Rendering::places ? nearness(contact, actuator) : (serves ? 1 : 0);
    if (part > 0) spot.push_back({index, part});
  }
  return spot;
}

}  // namespace telehug
