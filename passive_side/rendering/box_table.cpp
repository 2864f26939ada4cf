// SPDX-License-Identifier: Apache-2.0
#include "rendering/box_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "rendering/geometry.hpp"

namespace telehug {
namespace {

bool serves(const Actuator& actuator, int box) {
  return std::ranges::find(actuator.boxes, box) != actuator.boxes.end();
}

}  // namespace

int standard_box(const Contact& contact) {
  if (contact.grid.columns == standard_columns && contact.box >= 1 &&
      contact.box <= contact.grid.columns * contact.grid.rows) {
    return contact.box;
  }
  return standard_box_at(contact.body);
}

Spot motors_of_box(const Contact& contact, const JacketProfile& profile) {
  Spot spot;
  const int box = standard_box(contact);
  std::optional<std::size_t> nearest;
  double nearest_fh = std::numeric_limits<double>::infinity();
  for (std::size_t index = 0; index < std::min(profile.actuators.size(), max_actuators); ++index) {
    const Actuator& actuator = profile.actuators[index];
    if (!actuator.enabled || actuator.kind != ActuatorKind::motor) continue;
    if (serves(actuator, box)) spot.push_back({index, 1});
    const double away_fh = distance_fh(actuator.place, contact.body);
    if (away_fh >= nearest_fh) continue;  // also where the contact is nowhere
    nearest = index;
    nearest_fh = away_fh;
  }
  if (spot.empty() && nearest && finite(contact.body) && profile.uncovered == Uncovered::nearest)
    spot.push_back({*nearest, 1});
  return spot;
}

}  // namespace telehug
