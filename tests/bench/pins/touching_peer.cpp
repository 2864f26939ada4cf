// SPDX-License-Identifier: Apache-2.0
#include "bench/pins/touching_peer.hpp"

#include <utility>

#include "peer/heartbeat_exchange.hpp"
#include "peer/session_id.hpp"

namespace telehug {

TouchingPeer::TouchingPeer(const DdsSettings& settings)
    : session_(new_session_id()),
      participant_(settings),
      heartbeats_(participant_),
      events_(participant_),
      peer_(participant_, [this](const Heartbeat&) { heard_ = true; }),
      felt_(participant_,
            [this](const Felt& answer) {
              const std::lock_guard lock(mutex_);
              answers_.push_back(answer);
            }),
      thread_([this] { beat(); }) {
  event_.session = session_;
  event_.body_map_version = 1;
}

TouchingPeer::~TouchingPeer() {
  ending_ = true;
  thread_.join();
}

void TouchingPeer::beat() {
  HeartbeatExchange exchange(session_, Side::active);
  while (!ending_) {
    if (clock_.now() >= exchange.next_due()) heartbeats_.write(exchange.beat(clock_.now()));
    std::this_thread::sleep_for(5ms);
  }
}

void TouchingPeer::send(const std::vector<Contact>& contacts) {
  ++event_.sequence;
  event_.frame_time_ns = event_.sent_time_ns = to_ns(clock_.now());
  event_.contacts.assign(contacts.begin(), contacts.end());
  for (const Contact& contact : contacts) {
    if (contact.phase == Phase::move) continue;
    if (event_.transitions.size() == event_.transitions.capacity())
      event_.transitions.erase(event_.transitions.begin());
    event_.transitions.push_back({event_.sequence, event_.frame_time_ns, contact});
  }
  events_.write(event_);
}

std::vector<Felt> TouchingPeer::take_answers() {
  const std::lock_guard lock(mutex_);
  return std::exchange(answers_, {});
}

}  // namespace telehug
