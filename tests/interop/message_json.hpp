// SPDX-License-Identifier: Apache-2.0
//
// Messages as cyclone/wearer_side.c prints them.
#pragma once

#include <nlohmann/json.hpp>

#include "common/messages.hpp"
#include "common/names.hpp"

namespace telehug {

inline nlohmann::json as_printed(const Contact& contact) {
  return {{"id", contact.id},
          {"phase", name_of(contact.phase)},
          {"box", contact.box},
          {"columns", contact.grid.columns},
          {"rows", contact.grid.rows},
          {"body_x_fh", contact.body.x_fh},
          {"body_y_fh", contact.body.y_fh},
          {"screen_x_mm", contact.screen.x_mm},
          {"screen_y_mm", contact.screen.y_mm},
          {"speed_mm_s", contact.speed_mm_s},
          {"strength", contact.strength},
          {"gesture", name_of(contact.gesture)}};
}

inline nlohmann::json as_printed(const TouchEvent& event) {
  nlohmann::json contacts = nlohmann::json::array();
  for (const Contact& contact : event.contacts)
    contacts.push_back(as_printed(contact));
  nlohmann::json transitions = nlohmann::json::array();
  for (const Transition& transition : event.transitions) {
    transitions.push_back({{"event_sequence", transition.event_sequence},
                           {"frame_time_ns", transition.frame_time_ns},
                           {"contact", as_printed(transition.contact)}});
  }
  return {{"topic", "touch"},
          {"session", event.session},
          {"sequence", event.sequence},
          {"frame_time_ns", event.frame_time_ns},
          {"sent_time_ns", event.sent_time_ns},
          {"body_map_version", event.body_map_version},
          {"contacts", contacts},
          {"transitions", transitions}};
}

inline nlohmann::json as_printed(const Heartbeat& heartbeat) {
  const SessionId none(32, '0');
  return {{"topic", "heartbeat"},
          {"session", heartbeat.session},
          {"side", heartbeat.side == Side::active ? "active" : "passive"},
          {"sequence", heartbeat.sequence},
          {"sent_time_ns", heartbeat.sent_time_ns},
          {"echo_session", heartbeat.echo_session.empty() ? none : heartbeat.echo_session},
          {"echo_sent_time_ns", heartbeat.echo_sent_time_ns},
          {"echo_held_ns", heartbeat.echo_held_ns}};
}

inline nlohmann::json as_printed(const SideStatus& status) {
  return {{"topic", "status"},
          {"session", status.session},
          {"side", status.side == Side::active ? "active" : "passive"},
          {"ready", status.ready},
          {"stopped", status.stopped},
          {"version", status.version},
          {"reason", status.reason}};
}

inline nlohmann::json as_printed(const StopAll& stop) {
  return {{"topic", "stop"},
          {"session", stop.session},
          {"side", stop.side == Side::active ? "active" : "passive"},
          {"sequence", stop.sequence},
          {"stop", stop.stop},
          {"reason", stop.reason}};
}

}  // namespace telehug
