// SPDX-License-Identifier: Apache-2.0
#include "dds/wire.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>

#include "peer/session_id.hpp"

namespace telehug {

namespace {

constexpr std::string_view hex_digits = "0123456789abcdef";

std::uint8_t digit_value(char digit) {
  return static_cast<std::uint8_t>(hex_digits.find(digit));
}

// An empty session becomes 16 zeros.
v1::SessionBytes session_bytes(std::string_view session) {
  v1::SessionBytes bytes{};
  if (session.size() != session_id_digits) return bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::uint8_t>(digit_value(session[2 * i]) << 4U | digit_value(session[2 * i + 1]));
  }
  return bytes;
}

void read_session(const v1::SessionBytes& bytes, SessionId& session) {
  session.clear();
  if (bytes == v1::SessionBytes{}) return;
  for (const std::uint8_t byte : bytes) {
    session += hex_digits[byte >> 4U];
    session += hex_digits[byte & 0xFU];
  }
}

// Enums are 32 bits wide on the wire and 8 here. Numbers are equal in both; too large ones become 255, which validate()
// knows to be none.
template <typename WireEnum, typename Enum>
WireEnum wire_enum(Enum value) {
  return static_cast<WireEnum>(static_cast<std::uint8_t>(value));
}
template <typename Enum, typename WireEnum>
Enum read_enum(WireEnum value) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint8_t>::max();
  return static_cast<Enum>(std::min(static_cast<std::uint32_t>(value), none));
}

// The longest beginning of text that fits and does not cut a UTF-8 character in two.
std::string_view cut(std::string_view text, std::size_t max_bytes) {
  if (text.size() <= max_bytes) return text;
  std::size_t end = max_bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
    --end;
  return text.substr(0, end);
}

template <std::size_t max_bytes>
void write_text(std::string_view text, eprosima::fastrtps::fixed_string<max_bytes>& wire) {
  // Not assign(): it ends the text nowhere, so that the tail of a longer one before it would be sent along.
  wire = std::string(cut(text, max_bytes));
}

void contact_to_wire(const Contact& contact, v1::Contact& wire) {
  wire.id(contact.id);
  wire.phase(wire_enum<v1::Phase>(contact.phase));
  wire.box(contact.box);
  wire.grid().columns(contact.grid.columns);
  wire.grid().rows(contact.grid.rows);
  wire.body_x_fh(contact.body.x_fh);
  wire.body_y_fh(contact.body.y_fh);
  wire.screen_x_mm(contact.screen.x_mm);
  wire.screen_y_mm(contact.screen.y_mm);
  wire.speed_mm_s(contact.speed_mm_s);
  wire.strength(contact.strength);
  wire.gesture(wire_enum<v1::Gesture>(contact.gesture));
}

Contact contact_from_wire(const v1::Contact& wire) {
  return {.id = wire.id(),
          .phase = read_enum<Phase>(wire.phase()),
          .box = wire.box(),
          .grid = {.columns = wire.grid().columns(), .rows = wire.grid().rows()},
          .body = {.x_fh = wire.body_x_fh(), .y_fh = wire.body_y_fh()},
          .screen = {.x_mm = wire.screen_x_mm(), .y_mm = wire.screen_y_mm()},
          .speed_mm_s = wire.speed_mm_s(),
          .strength = wire.strength(),
          .gesture = read_enum<Gesture>(wire.gesture())};
}

}  // namespace

void to_wire(const TouchEvent& event, v1::TouchEvent& wire) {
  wire.session(session_bytes(event.session));
  wire.sequence_number(event.sequence);
  wire.frame_time_ns(event.frame_time_ns);
  wire.sent_time_ns(event.sent_time_ns);
  wire.body_map_version(event.body_map_version);
  wire.contacts().resize(event.contacts.size());
  for (std::size_t i = 0; i < event.contacts.size(); ++i)
    contact_to_wire(event.contacts[i], wire.contacts()[i]);
  wire.transitions().resize(event.transitions.size());
  for (std::size_t i = 0; i < event.transitions.size(); ++i) {
    const Transition& transition = event.transitions[i];
    v1::Transition& wire_transition = wire.transitions()[i];
    wire_transition.event_sequence(transition.event_sequence);
    wire_transition.frame_time_ns(transition.frame_time_ns);
    contact_to_wire(transition.contact, wire_transition.contact());
  }
}

Fault from_wire(const v1::TouchEvent& wire, TouchEvent& event) {
  if (wire.contacts().size() > event.contacts.capacity()) return "there are more contacts than fingers";
  if (wire.transitions().size() > event.transitions.capacity()) return "there are too many transitions";
  read_session(wire.session(), event.session);
  event.sequence = wire.sequence_number();
  event.frame_time_ns = wire.frame_time_ns();
  event.sent_time_ns = wire.sent_time_ns();
  event.body_map_version = wire.body_map_version();
  event.contacts.clear();
  for (const v1::Contact& contact : wire.contacts())
    event.contacts.push_back(contact_from_wire(contact));
  event.transitions.clear();
  for (const v1::Transition& transition : wire.transitions()) {
    event.transitions.push_back({.event_sequence = transition.event_sequence(),
                                 .frame_time_ns = transition.frame_time_ns(),
                                 .contact = contact_from_wire(transition.contact())});
  }
  return validate(event);
}

void to_wire(const Felt& felt, v1::Felt& wire) {
  wire.session(session_bytes(felt.session));
  wire.touch_session(session_bytes(felt.touch_session));
  wire.touch_sequence(felt.touch_sequence);
  wire.contact_id(felt.contact_id);
  wire.phase(wire_enum<v1::Phase>(felt.phase));
  wire.box(felt.box);
  wire.outcome(wire_enum<v1::FeltOutcome>(felt.outcome));
  wire.actuators().assign(felt.actuators.begin(), felt.actuators.end());
  wire.received_time_ns(felt.received_time_ns);
  wire.driven_time_ns(felt.driven_time_ns);
}

Fault from_wire(const v1::Felt& wire, Felt& felt) {
  if (wire.actuators().size() > felt.actuators.capacity()) return "there are too many actuators";
  read_session(wire.session(), felt.session);
  read_session(wire.touch_session(), felt.touch_session);
  felt.touch_sequence = wire.touch_sequence();
  felt.contact_id = wire.contact_id();
  felt.phase = read_enum<Phase>(wire.phase());
  felt.box = wire.box();
  felt.outcome = read_enum<FeltOutcome>(wire.outcome());
  felt.actuators.assign(wire.actuators().begin(), wire.actuators().end());
  felt.received_time_ns = wire.received_time_ns();
  felt.driven_time_ns = wire.driven_time_ns();
  return validate(felt);
}

void to_wire(const Heartbeat& heartbeat, v1::Heartbeat& wire) {
  wire.session(session_bytes(heartbeat.session));
  wire.side(wire_enum<v1::Side>(heartbeat.side));
  wire.sequence_number(heartbeat.sequence);
  wire.sent_time_ns(heartbeat.sent_time_ns);
  wire.echo_session(session_bytes(heartbeat.echo_session));
  wire.echo_sent_time_ns(heartbeat.echo_sent_time_ns);
  wire.echo_held_ns(heartbeat.echo_held_ns);
}

Fault from_wire(const v1::Heartbeat& wire, Heartbeat& heartbeat) {
  read_session(wire.session(), heartbeat.session);
  heartbeat.side = read_enum<Side>(wire.side());
  heartbeat.sequence = wire.sequence_number();
  heartbeat.sent_time_ns = wire.sent_time_ns();
  read_session(wire.echo_session(), heartbeat.echo_session);
  heartbeat.echo_sent_time_ns = wire.echo_sent_time_ns();
  heartbeat.echo_held_ns = wire.echo_held_ns();
  return validate(heartbeat);
}

void to_wire(const SideStatus& status, v1::SideStatus& wire) {
  wire.session(session_bytes(status.session));
  wire.side(wire_enum<v1::Side>(status.side));
  write_text(status.version, wire.version());
  wire.ready(status.ready);
  wire.stopped(status.stopped);
  write_text(status.reason, wire.reason());
}

Fault from_wire(const v1::SideStatus& wire, SideStatus& status) {
  read_session(wire.session(), status.session);
  status.side = read_enum<Side>(wire.side());
  status.version = wire.version().c_str();
  status.ready = wire.ready();
  status.stopped = wire.stopped();
  status.reason = wire.reason().c_str();
  return validate(status);
}

void to_wire(const StopAll& stop, v1::StopAll& wire) {
  wire.session(session_bytes(stop.session));
  wire.side(wire_enum<v1::Side>(stop.side));
  wire.sequence_number(stop.sequence);
  wire.stop(stop.stop);
  write_text(stop.reason, wire.reason());
}

Fault from_wire(const v1::StopAll& wire, StopAll& stop) {
  read_session(wire.session(), stop.session);
  stop.side = read_enum<Side>(wire.side());
  stop.sequence = wire.sequence_number();
  stop.stop = wire.stop();
  stop.reason = wire.reason().c_str();
  return validate(stop);
}

void to_wire(const PairRenewal& renewal, v1::PairRenewal& wire) {
  wire.session(session_bytes(renewal.session));
  write_text(renewal.certificate, wire.certificate());
  write_text(renewal.permissions, wire.permissions());
}

Fault from_wire(const v1::PairRenewal& wire, PairRenewal& renewal) {
  read_session(wire.session(), renewal.session);
  renewal.certificate = wire.certificate().c_str();
  renewal.permissions = wire.permissions().c_str();
  return validate(renewal);
}

void to_wire(const Hug& hug, v1::Hug& wire) {
  wire.session(session_bytes(hug.session));
  wire.sequence_number(hug.sequence);
  wire.sent_time_ns(hug.sent_time_ns);
  wire.strength(hug.strength);
}

Fault from_wire(const v1::Hug& wire, Hug& hug) {
  read_session(wire.session(), hug.session);
  hug.sequence = wire.sequence_number();
  hug.sent_time_ns = wire.sent_time_ns();
  hug.strength = wire.strength();
  return validate(hug);
}

}  // namespace telehug
