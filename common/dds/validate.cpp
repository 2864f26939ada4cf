// SPDX-License-Identifier: Apache-2.0
#include "dds/validate.hpp"

#include <algorithm>
#include <cmath>

#include "common/printable.hpp"
#include "peer/session_id.hpp"

namespace telehug {

namespace {

bool within(double value, double limit) {
  return std::isfinite(value) && std::abs(value) <= limit;
}

bool known(Phase phase) {
  return phase == Phase::down || phase == Phase::move || phase == Phase::up;
}
bool known(Gesture gesture) {
  return static_cast<std::uint8_t>(gesture) < gesture_count;
}
bool known(Side side) {
  return side == Side::active || side == Side::passive;
}
bool known(FeltOutcome outcome) {
  return static_cast<std::uint8_t>(outcome) < felt_outcome_count;
}

// PEM and S/MIME.
bool lines_of_ascii(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return (c >= 0x20 && c < 0x7F) || c == '\n' || c == '\r'; });
}

Fault validate(const Contact& contact) {
  if (!known(contact.phase)) return "a contact's phase is unknown";
  if (!known(contact.gesture)) return "a contact's gesture is unknown";
  const GridShape grid = contact.grid;
  if (grid.columns < 1 || grid.columns > max_grid_boxes_per_side || grid.rows < 1 ||
      grid.rows > max_grid_boxes_per_side) {
    return "a contact's grid has no possible shape";
  }
  if (contact.box < 1 || contact.box > grid.columns * grid.rows) return "a contact's box is not in its grid";
  if (!within(contact.screen.x_mm, max_screen_mm) || !within(contact.screen.y_mm, max_screen_mm)) {
    return "a contact's place on the screen is impossible";
  }
  if (!within(contact.body.x_fh, max_body_fh) || !within(contact.body.y_fh, max_body_fh)) {
    return "a contact's place on the body is impossible";
  }
  if (!within(contact.speed_mm_s, max_speed_mm_s) || contact.speed_mm_s < 0) return "a contact's speed is impossible";
  if (!std::isfinite(contact.strength) || contact.strength < 0 || contact.strength > 1) {
    return "a contact's strength is not within 0 and 1";
  }
  return nullptr;
}

Fault validate(const Transition& transition, std::uint64_t event_sequence) {
  if (transition.event_sequence < 1 || transition.event_sequence > event_sequence) {
    return "a transition is not from this event or one before";
  }
  if (transition.frame_time_ns < 0) return "a transition's frame time is negative";
  if (transition.contact.phase == Phase::move) return "a transition is neither down nor up";
  return validate(transition.contact);
}

}  // namespace

Fault validate(const TouchEvent& event) noexcept {
  if (!is_session_id(event.session)) return "the session is not 32 hexadecimal digits";
  if (event.sequence < 1) return "the sequence number is 0";
  if (event.frame_time_ns < 0 || event.sent_time_ns < 0) return "a time is negative";
  if (!event.contacts.empty() && event.body_map_version == 0) return "there are contacts but no body map";
  for (auto contact = event.contacts.begin(); contact != event.contacts.end(); ++contact) {
    if (const Fault fault = validate(*contact)) return fault;
    const auto same_id = [&](const Contact& other) { return other.id == contact->id; };
    if (std::any_of(event.contacts.begin(), contact, same_id)) return "two contacts have one id";
  }
  std::uint64_t newest = 1;
  for (const Transition& transition : event.transitions) {
    if (const Fault fault = validate(transition, event.sequence)) return fault;
    if (transition.event_sequence < newest) return "the transitions are not in order";
    newest = transition.event_sequence;
  }
  return nullptr;
}

Fault validate(const Felt& felt) noexcept {
  if (!is_session_id(felt.session) || !is_session_id(felt.touch_session)) {
    return "a session is not 32 hexadecimal digits";
  }
  if (felt.touch_sequence < 1) return "the sequence number is 0";
  if (!known(felt.phase)) return "the phase is unknown";
  if (!known(felt.outcome)) return "the outcome is unknown";
  if (felt.box < 1 || felt.box > max_grid_boxes_per_side * max_grid_boxes_per_side) return "the box is impossible";
  if (felt.received_time_ns < 0 || felt.driven_time_ns < 0) return "a time is negative";
  return nullptr;
}

Fault validate(const Heartbeat& heartbeat) noexcept {
  if (!is_session_id(heartbeat.session)) return "the session is not 32 hexadecimal digits";
  if (!known(heartbeat.side)) return "the side is unknown";
  if (heartbeat.sequence < 1) return "the sequence number is 0";
  if (!heartbeat.echo_session.empty() && !is_session_id(heartbeat.echo_session)) {
    return "the echoed session is not 32 hexadecimal digits";
  }
  if (heartbeat.sent_time_ns < 0 || heartbeat.echo_sent_time_ns < 0 || heartbeat.echo_held_ns < 0) {
    return "a time is negative";
  }
  return nullptr;
}

Fault validate(const SideStatus& status) noexcept {
  if (!is_session_id(status.session)) return "the session is not 32 hexadecimal digits";
  if (!known(status.side)) return "the side is unknown";
  if (!printable(status.version) || !printable(status.reason)) return "a text is not printable UTF-8";
  return nullptr;
}

Fault validate(const StopAll& stop) noexcept {
  if (!is_session_id(stop.session)) return "the session is not 32 hexadecimal digits";
  if (!known(stop.side)) return "the side is unknown";
  if (stop.sequence < 1) return "the sequence number is 0";
  if (!printable(stop.reason)) return "a text is not printable UTF-8";
  return nullptr;
}

Fault validate(const PairRenewal& renewal) noexcept {
  if (!is_session_id(renewal.session)) return "the session is not 32 hexadecimal digits";
  if (renewal.certificate.empty() || renewal.permissions.empty()) return "a part of the renewal is missing";
  if (renewal.certificate.size() > max_renewed_certificate || renewal.permissions.size() > max_renewed_permissions)
    return "a part of the renewal is too long";
  if (!lines_of_ascii(renewal.certificate) || !lines_of_ascii(renewal.permissions))
    return "a part of the renewal is no plain text";
  return nullptr;
}

Fault validate(const Hug& hug) noexcept {
  if (!is_session_id(hug.session)) return "the session is not 32 hexadecimal digits";
  if (hug.sequence < 1) return "the sequence number is 0";
  if (hug.sent_time_ns < 0) return "a time is negative";
  if (!(hug.strength > 0) || hug.strength > 1) return "the strength is not above 0 and up to 1";
  return nullptr;
}

}  // namespace telehug
