// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstdint>

#include "common/messages.hpp"
#include "peer/session_succession.hpp"

namespace telehug {

// What one TouchEvent adds to the ones before it.
struct OrderedTouch {
  const TouchEvent* event = nullptr;  // the one that was given
  bool new_session = false;           // the sender was restarted: every contact of before is over
  // Downs and ups that were not delivered before, oldest first, each exactly once; those of lost events among them.
  boost::container::static_vector<Transition, max_transitions> transitions;
  // Contacts that are over although no up came (so many events were lost that it was not repeated any more).
  boost::container::static_vector<std::uint32_t, max_contacts> ended;
};

struct TouchOrderCounters {
  std::uint64_t accepted = 0;
  std::uint64_t lost = 0;        // numbers that were skipped and did not come later
  std::uint64_t duplicates = 0;  // dropped
  std::uint64_t overtaken = 0;   // dropped: a newer one came before
  std::uint64_t retired = 0;     // dropped: of a session that was replaced
  std::uint64_t sessions = 0;
  std::uint64_t recovered = 0;  // transitions whose own event was lost
};

// Brings the events of the touch topic, which may be lost, doubled or overtaken, into order. Events must be valid (as
// Reader<TouchEvent> delivers them). Allocates only when a new session begins.
class TouchOrder {
 public:
  // Null: dropped (and counted). The answer is valid until the next call and as long as `event`.
  const OrderedTouch* accept(const TouchEvent& event);

  [[nodiscard]] const TouchOrderCounters& counters() const noexcept { return counters_; }

 private:
  bool is_next(std::uint64_t sequence);
  void begin_session();
  void match_with_state(const TouchEvent& event);

  SessionSuccession sessions_;
  std::uint64_t first_sequence_ = 0;  // of the session, as far as it was heard
  std::uint64_t last_sequence_ = 0;
  std::uint64_t seen_ = 0;  // bit i: last_sequence_ - i came
  boost::container::static_vector<std::uint32_t, max_contacts + max_transitions> down_;
  OrderedTouch ordered_;
  TouchOrderCounters counters_;
};

}  // namespace telehug
