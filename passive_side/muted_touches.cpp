// SPDX-License-Identifier: Apache-2.0
#include "muted_touches.hpp"

#include <algorithm>

#include "safety/muted_place.hpp"

namespace telehug {

const TouchEvent& MutedTouches::leave_out(const OrderedTouch& touch, const MutedBoxes& muted) {
  const TouchEvent& event = *touch.event;
  left_out_.clear();
  fresh_ = {touch.transitions.data(), touch.transitions.size()};
  if (muted.none()) return event;

  allowed_ = event;
  allowed_.contacts.clear();
  for (const Contact& contact : event.contacts) {
    if (is_muted(contact, muted)) {
      left_out_.push_back({event.sequence, event.frame_time_ns, contact});
    } else {
      allowed_.contacts.push_back(contact);
    }
  }
  allowed_fresh_.clear();
  for (const Transition& transition : touch.transitions) {
    if (!is_muted(transition.contact, muted)) {
      allowed_fresh_.push_back(transition);
      continue;
    }
    const bool is_there = std::ranges::any_of(left_out_, [&transition](const Transition& other) {
      return other.event_sequence == transition.event_sequence && other.contact.id == transition.contact.id &&
             other.contact.phase == transition.contact.phase;
    });
    if (!is_there) left_out_.push_back(transition);
  }
  fresh_ = {allowed_fresh_.data(), allowed_fresh_.size()};
  return allowed_;
}

}  // namespace telehug
