// SPDX-License-Identifier: Apache-2.0
#include "boxes_under.hpp"

#include "body_map/vitruvian_grid.hpp"

namespace telehug {

BoxedContacts boxes_under(const ContactStates& contacts, const BodyMap& map, Duration max_age, Timestamp now,
                          NobodyTouched& nobody) {
  BoxedContacts boxed;
  const bool no_face = map.version == 0;
  const bool too_old = !no_face && now - map.seen > max_age;
  for (const ContactState& contact : contacts) {
    const auto hit = no_face || too_old ? std::nullopt : box_at(map, contact.screen);
    if (hit) {
      boxed.push_back({.id = contact.id,
                       .phase = contact.phase,
                       .screen = contact.screen,
                       .speed_mm_s = contact.speed_mm_s,
                       .grid = map.shape,
                       .box = hit->box,
                       .body = hit->body,
                       .gesture = contact.gesture});
    } else if (contact.phase == Phase::down) {
      ++(no_face ? nobody.no_face : too_old ? nobody.map_too_old : nobody.outside_grid);
    }
  }
  return boxed;
}

}  // namespace telehug
