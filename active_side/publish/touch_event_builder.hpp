// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstdint>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "publish/boxed_contact.hpp"

namespace telehug {

// Turns each frame's contacts into the event that is sent for it. Events travel without resending, so each tells the
// whole state again and repeats the downs and ups of the last frames: the loss of any few events in a row loses
// nothing.
//
// It keeps its own account of which contacts are down, so that what is sent is always one down, moves, one up: a
// contact that appears without a down (it slid into the grid) begins with one, one that disappears without an up (it
// slid out, or the body map was lost) ends with one, and an up of an unknown contact is left out. Allocates nothing.
class TouchEventBuilder {
 public:
  // A transition is repeated until it was in this many events after its first, or is this old, whichever comes first.
  static constexpr int max_repeats = 8;
  static constexpr Duration max_repeat_time = 500ms;

  // session: as made by new_session_id().
  explicit TouchEventBuilder(SessionId session);

  // contacts: all of this frame, ids unique. body_map_version: of the map that they were read against; not 0 if there
  // are contacts. frame_time: rises from call to call.
  //
  // Null when there is nothing to say: no contact and no transition left to repeat. The event is valid until the next
  // call; sent_time_ns is `now`.
  const TouchEvent* build(const BoxedContacts& contacts, std::uint32_t body_map_version, Timestamp frame_time,
                          Timestamp now);

  // Repeats no begin of a touch any longer, but of those in `contacts`: what was stopped meanwhile is not felt by a
  // jacket that starts just then.
  void withhold_downs_except(const BoxedContacts& contacts);

 private:
  struct Pending {
    Transition transition;
    int told = 0;  // in how many events
  };

  void forget_old_transitions(Timestamp frame_time);
  void end_vanished(const BoxedContacts& contacts);
  void add_contact(const BoxedContact& boxed);
  void add_transition(const Contact& contact, Phase phase);

  TouchEvent event_;
  boost::container::static_vector<Contact, max_contacts> down_;  // as sent last
  boost::container::static_vector<Pending, max_transitions> pending_;
};

}  // namespace telehug
