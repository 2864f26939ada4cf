// SPDX-License-Identifier: Apache-2.0
//
// What travels between the two PCs, as plain values. idl/telehug.idl is their form on the wire; common/dds converts and
// validates. Times are the *sender's* monotonic clock in ns (clock.hpp): two of them from one sender can be subtracted,
// a sender's and a receiver's can't.
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <string>

#include "common/units.hpp"

namespace telehug {

inline constexpr std::size_t max_contacts = 10;
inline constexpr std::size_t max_transitions = 16;
inline constexpr std::size_t max_felt_actuators = 16;

enum class Phase : std::uint8_t { down = 0, move = 1, up = 2 };

// How a contact touches. It is `none` until that is certain, and may then become another (a hold that begins to move is
// a stroke); with `up` it is what the contact was: exactly one.
enum class Gesture : std::uint8_t { none = 0, tap = 1, hold = 2, stroke = 3, pat = 4, hug = 5 };
inline constexpr std::uint8_t gesture_count = 6;

// Shape of the grid of boxes that a box number refers to: `columns` boxes a row, numbered from 1, row by row, left to
// right as seen on the screen.
struct GridShape {
  std::uint16_t columns = 0;
  std::uint16_t rows = 0;
  friend bool operator==(const GridShape&, const GridShape&) = default;
};

// One finger on the screen, read against one body map.
struct Contact {
  std::uint32_t id = 0;  // lives from down to up; unique within the sender's session
  Phase phase = Phase::down;
  std::uint16_t box = 0;  // 1..columns*rows
  GridShape grid;
  BodyPoint body;
  ScreenPoint screen;
  double speed_mm_s = 0;
  double strength = 1;  // 0..1
  Gesture gesture = Gesture::none;
};

// A down or an up that happened lately, repeated in the following events so that a lost sample loses nothing.
struct Transition {
  std::uint64_t event_sequence = 0;  // the event in which it was new
  std::int64_t frame_time_ns = 0;
  Contact contact;  // phase is down or up
};

// Identifies one run of one program: 32 hexadecimal digits, new at every start.
using SessionId = std::string;

struct TouchEvent {
  SessionId session;
  std::uint64_t sequence = 0;      // 1, 2, ... within the session
  std::int64_t frame_time_ns = 0;  // when the camera took the frame
  std::int64_t sent_time_ns = 0;
  std::uint32_t body_map_version = 0;  // that contacts were read against; the largest number: the standard grid itself
  boost::container::static_vector<Contact, max_contacts>
      contacts;  // the whole state: what is not in it is not touching
  boost::container::static_vector<Transition, max_transitions> transitions;  // oldest first
};

enum class FeltOutcome : std::uint8_t {
  driven = 0,         // `actuators` were given to the jacket
  uncovered = 1,      // no actuator serves this place
  stopped = 2,        // the wearer's stop is latched
  stale = 3,          // too old to be felt
  jacket_absent = 4,  // no jacket answers
  limited = 5,        // a limit left nothing of it
  // What the wearer wants (or not just now):
  paused = 6,
  quiet_hours = 7,
  muted = 8,           // at this place
  another_sender = 9,  // somebody else touches, and one at a time may
};
inline constexpr std::uint8_t felt_outcome_count = 10;

// The passive side's answer to one contact of one TouchEvent.
struct Felt {
  SessionId session;        // of the passive side
  SessionId touch_session;  // of the sender of the touch
  std::uint64_t touch_sequence = 0;
  std::uint32_t contact_id = 0;
  Phase phase = Phase::down;
  std::uint16_t box = 0;
  FeltOutcome outcome = FeltOutcome::driven;
  boost::container::static_vector<std::uint8_t, max_felt_actuators> actuators;  // ids of the jacket profile
  std::int64_t received_time_ns = 0;
  std::int64_t driven_time_ns = 0;  // last byte handed to the link; 0 if not driven
};

enum class Side : std::uint8_t { active = 0, passive = 1 };

// "I live and my pipeline runs", every 100 ms. `echo_*` return the peer's newest heartbeat for a round-trip estimate.
struct Heartbeat {
  SessionId session;
  Side side = Side::active;
  std::uint64_t sequence = 0;
  std::int64_t sent_time_ns = 0;
  SessionId echo_session;              // empty: none heard yet
  std::int64_t echo_sent_time_ns = 0;  // the peer's own stamp
  std::int64_t echo_held_ns = 0;       // how long it lay here before this answer
};

// What a side tells the other of itself whenever it changes.
struct SideStatus {
  SessionId session;
  Side side = Side::active;
  std::string version;
  bool ready = false;    // active: calibrated, face found, sending; passive: jacket connected and not stopped
  bool stopped = false;  // stop is latched
  std::string reason;    // why not ready, one sentence; empty if ready
};

// Turn everything off, now. Sent by either side.
struct StopAll {
  SessionId session;
  Side side = Side::active;
  std::uint64_t sequence = 0;
  bool stop = true;  // false: the sender's own stop is over
  std::string reason;
};

inline constexpr std::size_t max_renewed_certificate = 8192;
inline constexpr std::size_t max_renewed_permissions = 16384;

// Passive side: what lets the other side go on in its pair when its certificate ends (pairing.hpp).
struct PairRenewal {
  SessionId session;
  std::string certificate;  // PEM
  std::string permissions;  // S/MIME
};

// The wearer hugs back: seen and heard by the active side's person, felt by nobody.
struct Hug {
  SessionId session;
  std::uint64_t sequence = 0;
  std::int64_t sent_time_ns = 0;
  double strength = 1;  // above 0, up to 1
};

}  // namespace telehug
