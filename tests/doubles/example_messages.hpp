// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/messages.hpp"

namespace telehug {

// Valid messages with a different value in every field, for tests to start from.

inline const SessionId example_session = "0123456789abcdef0123456789abcdef";
inline const SessionId other_session = "fedcba9876543210fedcba9876543210";

inline Contact example_contact(std::uint32_t id, Phase phase = Phase::move) {
  return {.id = id,
          .phase = phase,
          .box = 7,
          .grid = {.columns = 5, .rows = 4},
          .body = {.x_fh = -0.25, .y_fh = 0.75},
          .screen = {.x_mm = 210.5, .y_mm = 180.25},
          .speed_mm_s = 31.5,
          .strength = 0.5,
          .gesture = Gesture::stroke};
}

inline TouchEvent example_touch() {
  TouchEvent event;
  event.session = example_session;
  event.sequence = 42;
  event.frame_time_ns = 1'000'000'001;
  event.sent_time_ns = 1'000'000'002;
  event.body_map_version = 3;
  event.contacts.push_back(example_contact(1));
  event.contacts.push_back(example_contact(2, Phase::up));
  event.transitions.push_back({.event_sequence = 40, .frame_time_ns = 999, .contact = example_contact(1, Phase::down)});
  event.transitions.push_back({.event_sequence = 42, .frame_time_ns = 1'000, .contact = example_contact(2, Phase::up)});
  return event;
}

inline Felt example_felt() {
  Felt felt;
  felt.session = other_session;
  felt.touch_session = example_session;
  felt.touch_sequence = 42;
  felt.contact_id = 2;
  felt.phase = Phase::up;
  felt.box = 7;
  felt.outcome = FeltOutcome::limited;
  felt.actuators = {0, 3, 255};
  felt.received_time_ns = 5;
  felt.driven_time_ns = 6;
  return felt;
}

inline Heartbeat example_heartbeat() {
  return {.session = example_session,
          .side = Side::active,
          .sequence = 9,
          .sent_time_ns = 100,
          .echo_session = other_session,
          .echo_sent_time_ns = 50,
          .echo_held_ns = 20};
}

inline SideStatus example_status() {
  return {.session = example_session,
          .side = Side::active,
          .version = "0.1.0",
          .ready = true,
          .stopped = true,
          .reason = "the camera \u00bbC920\u00ab is unplugged"};
}

inline Hug example_hug() {
  return {.session = other_session, .sequence = 3, .sent_time_ns = 77, .strength = 0.5};
}

inline StopAll example_stop() {
  return {
      .session = example_session, .side = Side::active, .sequence = 2, .stop = true, .reason = "the wearer's button"};
}

inline PairRenewal example_renewal() {
  return {.session = other_session,
          .certificate = "-----BEGIN CERTIFICATE-----\nMIIB\n-----END CERTIFICATE-----\n",
          .permissions = "MIME-Version: 1.0\r\n\r\n<dds/>\r\n"};
}

}  // namespace telehug
