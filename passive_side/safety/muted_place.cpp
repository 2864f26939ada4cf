// SPDX-License-Identifier: Apache-2.0
#include "safety/muted_place.hpp"

namespace telehug {
namespace {

bool is_muted(BodyPoint place, const MutedBoxes& muted) {
  const int box = standard_box_at(place);
  return box != 0 && muted.test(static_cast<std::size_t>(box));
}

}  // namespace

bool is_muted(const Contact& contact, const MutedBoxes& muted) {
  const bool standard = contact.grid.columns == standard_columns;
  if (standard && contact.box < muted.size() && muted.test(contact.box)) return true;
  return is_muted(contact.body, muted);
}

bool is_muted(std::uint8_t actuator, BodyPoint place, const Permission& permission) {
  return permission.muted_actuators.test(actuator) || is_muted(place, permission.muted_boxes);
}

}  // namespace telehug
