// SPDX-License-Identifier: Apache-2.0
#include "publish/touch_event_builder.hpp"

#include <algorithm>
#include <utility>

namespace telehug {
namespace {

template <typename Contacts>
bool has(const Contacts& contacts, std::uint32_t id) {
  return std::any_of(contacts.begin(), contacts.end(), [id](const auto& contact) { return contact.id == id; });
}

}  // namespace

TouchEventBuilder::TouchEventBuilder(SessionId session) {
  event_.session = std::move(session);
}

const TouchEvent* TouchEventBuilder::build(const BoxedContacts& contacts, std::uint32_t body_map_version,
                                           Timestamp frame_time, Timestamp now) {
  forget_old_transitions(frame_time);
  if (contacts.empty() && down_.empty() && pending_.empty()) return nullptr;

  event_.sequence += 1;
  event_.frame_time_ns = to_ns(frame_time);
  event_.sent_time_ns = to_ns(now);
  event_.body_map_version = body_map_version;
  event_.contacts.clear();
  end_vanished(contacts);
  for (const BoxedContact& contact : contacts)
    add_contact(contact);
  event_.transitions.clear();
  for (Pending& pending : pending_) {
    event_.transitions.push_back(pending.transition);
    ++pending.told;
  }
  return &event_;
}

void TouchEventBuilder::withhold_downs_except(const BoxedContacts& contacts) {
  const auto withheld = [&](const Pending& pending) {
    const Contact& contact = pending.transition.contact;
    return contact.phase == Phase::down && !has(contacts, contact.id);
  };
  pending_.erase(std::remove_if(pending_.begin(), pending_.end(), withheld), pending_.end());
}

void TouchEventBuilder::forget_old_transitions(Timestamp frame_time) {
  const auto told_enough = [&](const Pending& pending) {
    return pending.told > max_repeats || frame_time - from_ns(pending.transition.frame_time_ns) >= max_repeat_time;
  };
  pending_.erase(std::remove_if(pending_.begin(), pending_.end(), told_enough), pending_.end());
}

void TouchEventBuilder::end_vanished(const BoxedContacts& contacts) {
  const auto vanished = [&](const Contact& known) { return !has(contacts, known.id); };
  for (const Contact& known : down_) {
    if (vanished(known)) add_transition(known, Phase::up);
  }
  down_.erase(std::remove_if(down_.begin(), down_.end(), vanished), down_.end());
}

void TouchEventBuilder::add_contact(const BoxedContact& boxed) {
  const auto known =
      std::find_if(down_.begin(), down_.end(), [&](const Contact& contact) { return contact.id == boxed.id; });
  if (boxed.phase == Phase::up && known == down_.end()) return;

  Contact contact{.id = boxed.id,
                  .phase = Phase::move,
                  .box = boxed.box,
                  .grid = boxed.grid,
                  .body = boxed.body,
                  .screen = boxed.screen,
                  .speed_mm_s = boxed.speed_mm_s,
                  .strength = boxed.strength,
                  .gesture = boxed.gesture};
  if (boxed.phase == Phase::up) {
    contact.phase = Phase::up;
    add_transition(contact, Phase::up);
    down_.erase(known);
  } else if (known == down_.end()) {
    contact.phase = Phase::down;
    add_transition(contact, Phase::down);
    down_.push_back(contact);
  } else {
    *known = contact;
  }
  event_.contacts.push_back(contact);
}

void TouchEventBuilder::add_transition(const Contact& contact, Phase phase) {
  if (pending_.size() == pending_.capacity()) pending_.erase(pending_.begin());
  Pending& added = pending_.emplace_back();
  added.transition = {.event_sequence = event_.sequence, .frame_time_ns = event_.frame_time_ns, .contact = contact};
  added.transition.contact.phase = phase;
}

}  // namespace telehug
