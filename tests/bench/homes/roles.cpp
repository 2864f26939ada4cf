// SPDX-License-Identifier: Apache-2.0
#include "bench/homes/roles.hpp"

#include <thread>

#include "bench/homes/arrival_log.hpp"
#include "bench/homes/planned_touch.hpp"
#include "common/clock.hpp"
#include "peer/session_id.hpp"
#include "subscribe/touch_order.hpp"

namespace telehug {
namespace {

std::unique_ptr<TouchSender> sender(Way way, const Meeting& meeting) {
  switch (way) {
    case Way::secured:
      return secured_sender(meeting);
    case Way::mqtt:
      return mqtt_sender(meeting);
    case Way::udp:
      break;
  }
  return udp_sender(meeting);
}

[[noreturn]] void receive(Way way, const Meeting& meeting, const Receive& receive) {
  switch (way) {
    case Way::secured:
      receive_secured(meeting, receive);
    case Way::mqtt:
      receive_mqtt(meeting, receive);
    case Way::udp:
      break;
  }
  receive_udp(meeting, receive);
}

}  // namespace

void send_touches(Way way, const Meeting& meeting, int rate_hz) {
  const SteadyClock clock;
  const auto out = sender(way, meeting);
  TouchEventBuilder builder(new_session_id());
  const Duration period = Duration(1s) / rate_hz;
  Timestamp next = clock.now();
  for (std::uint64_t sequence = 1;; ++sequence) {
    const BoxedContacts contacts = planned_touch(sequence);
    const Timestamp now = clock.now();
    const TouchEvent* event = builder.build(contacts, 1, now, now);
    if (event != nullptr) out->send(*event);
    next = std::max(next + period, clock.now());
    std::this_thread::sleep_until(next);
  }
}

void note_touches(Way way, const Meeting& meeting, const std::filesystem::path& file) {
  const SteadyClock clock;
  const ArrivalLog log(file);
  TouchOrder order;
  receive(way, meeting, [&](const TouchEvent& event) {
    const std::int64_t now_ns = to_ns(clock.now());
    log.add({Arrival::Of::state, now_ns, event.sequence, event.sent_time_ns});
    const OrderedTouch* ordered = order.accept(event);
    if (ordered == nullptr) return;
    for (const Transition& transition : ordered->transitions)
      log.add({Arrival::Of::transition, now_ns, transition.event_sequence, 0});
  });
}

}  // namespace telehug
