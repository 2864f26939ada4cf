// SPDX-License-Identifier: Apache-2.0
#include "subscribe/touch_order.hpp"

#include <algorithm>

namespace telehug {

namespace {
constexpr std::uint64_t remembered = 64;  // events of which it is known whether they came: the bits of seen_
}

const OrderedTouch* TouchOrder::accept(const TouchEvent& event) {
  const auto standing = sessions_.admit(event.session);
  if (standing == SessionSuccession::Standing::retired) {
    ++counters_.retired;
    return nullptr;
  }
  const bool new_session = standing == SessionSuccession::Standing::successor;
  if (new_session) begin_session();
  const std::uint64_t before = last_sequence_;
  if (!is_next(event.sequence)) return nullptr;

  ++counters_.accepted;
  // What came before the first event of a session that is seen was not lost: nobody listened.
  if (new_session) {
    first_sequence_ = event.sequence;
  } else {
    counters_.lost += event.sequence - before - 1;
  }
  ordered_.event = &event;
  ordered_.new_session = new_session;
  ordered_.transitions.clear();
  for (const Transition& transition : event.transitions) {
    // Every event carries all downs and ups of the events before it, as far as they are still repeated: those up to the
    // last accepted event were delivered with it or before.
    if (transition.event_sequence <= before) continue;
    if (transition.event_sequence != event.sequence) ++counters_.recovered;
    ordered_.transitions.push_back(transition);
  }
  match_with_state(event);
  return &ordered_;
}

void TouchOrder::begin_session() {
  ++counters_.sessions;
  last_sequence_ = 0;
  seen_ = 0;
  down_.clear();
}

bool TouchOrder::is_next(std::uint64_t sequence) {
  if (sequence > last_sequence_) {
    const std::uint64_t step = sequence - last_sequence_;
    seen_ = (step < remembered ? seen_ << step : 0) | 1U;
    last_sequence_ = sequence;
    return true;
  }
  const std::uint64_t back = last_sequence_ - sequence;
  const bool came = back >= remembered || (seen_ >> back & 1U) != 0;
  if (came) {
    ++counters_.duplicates;
    return false;
  }
  seen_ |= std::uint64_t{1} << back;
  ++counters_.overtaken;
  if (sequence > first_sequence_) --counters_.lost;  // it was counted when it was skipped
  return false;
}

void TouchOrder::match_with_state(const TouchEvent& event) {
  for (const Transition& transition : ordered_.transitions) {
    down_.erase(std::remove(down_.begin(), down_.end(), transition.contact.id), down_.end());
    if (transition.contact.phase == Phase::down) down_.push_back(transition.contact.id);
  }
  const auto touching = [&](std::uint32_t id) {
    return std::any_of(event.contacts.begin(), event.contacts.end(),
                       [&](const Contact& contact) { return contact.id == id && contact.phase != Phase::up; });
  };
  ordered_.ended.clear();
  for (const std::uint32_t id : down_) {
    if (!touching(id) && ordered_.ended.size() < ordered_.ended.capacity()) ordered_.ended.push_back(id);
  }
  down_.clear();
  for (const Contact& contact : event.contacts) {
    if (contact.phase != Phase::up) down_.push_back(contact.id);
  }
}

}  // namespace telehug
