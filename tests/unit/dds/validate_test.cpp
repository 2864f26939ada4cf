// SPDX-License-Identifier: Apache-2.0
#include "dds/validate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "doubles/example_messages.hpp"

namespace telehug {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

template <typename T>
struct Spoilt {
  const char* fault;
  std::function<void(T&)> spoil;
};

// Each spoils one thing in a valid message and expects the reason.
template <typename T>
void expect_faults(const T& valid, const std::vector<Spoilt<T>>& table) {
  EXPECT_EQ(validate(valid), nullptr);
  for (const Spoilt<T>& row : table) {
    T message = valid;
    row.spoil(message);
    EXPECT_STREQ(validate(message), row.fault);
  }
}

TEST(ATouchEvent, IsRefusedWithTheReason) {
  constexpr const char* session = "the session is not 32 hexadecimal digits";
  constexpr const char* grid = "a contact's grid has no possible shape";
  constexpr const char* box = "a contact's box is not in its grid";
  constexpr const char* screen = "a contact's place on the screen is impossible";
  constexpr const char* body = "a contact's place on the body is impossible";
  constexpr const char* speed = "a contact's speed is impossible";
  constexpr const char* strength = "a contact's strength is not within 0 and 1";
  constexpr const char* time = "a time is negative";
  constexpr const char* from = "a transition is not from this event or one before";
  expect_faults<TouchEvent>(
      example_touch(),
      {
          {session, [](auto& event) { event.session.clear(); }},
          {session, [](auto& event) { event.session[3] = 'x'; }},
          {"the sequence number is 0", [](auto& event) { event.sequence = 0; }},
          {time, [](auto& event) { event.frame_time_ns = -1; }},
          {time, [](auto& event) { event.sent_time_ns = std::numeric_limits<std::int64_t>::min(); }},
          {"there are contacts but no body map", [](auto& event) { event.body_map_version = 0; }},
          {"two contacts have one id", [](auto& event) { event.contacts[1].id = event.contacts[0].id; }},
          {"a contact's phase is unknown", [](auto& event) { event.contacts[0].phase = Phase{3}; }},
          {"a contact's gesture is unknown", [](auto& event) { event.contacts[0].gesture = Gesture{6}; }},
          {grid, [](auto& event) { event.contacts[0].grid.columns = 0; }},
          {grid, [](auto& event) { event.contacts[0].grid.rows = 101; }},
          {box, [](auto& event) { event.contacts[0].box = 0; }},
          {box, [](auto& event) { event.contacts[0].box = 21; }},
          {screen, [](auto& event) { event.contacts[1].screen.x_mm = nan_value; }},
          {screen, [](auto& event) { event.contacts[1].screen.y_mm = -10'001; }},
          {body, [](auto& event) { event.contacts[1].body.x_fh = infinite; }},
          {body, [](auto& event) { event.contacts[1].body.y_fh = nan_value; }},
          {speed, [](auto& event) { event.contacts[1].speed_mm_s = -0.1; }},
          {speed, [](auto& event) { event.contacts[1].speed_mm_s = nan_value; }},
          {strength, [](auto& event) { event.contacts[1].strength = 1.01; }},
          {strength, [](auto& event) { event.contacts[1].strength = -0.01; }},
          {strength, [](auto& event) { event.contacts[1].strength = nan_value; }},
          {from, [](auto& event) { event.transitions[0].event_sequence = 0; }},
          {from, [](auto& event) { event.transitions[1].event_sequence = 43; }},
          {"the transitions are not in order", [](auto& event) { event.transitions[1].event_sequence = 39; }},
          {"a transition's frame time is negative", [](auto& event) { event.transitions[0].frame_time_ns = -1; }},
          {"a transition is neither down nor up",
           [](auto& event) { event.transitions[0].contact.phase = Phase::move; }},
          {box, [](auto& event) { event.transitions[0].contact.box = 500; }},
      });
}

TEST(ATouchEvent, WithoutContactsNeedsNoBodyMap) {
  TouchEvent event = example_touch();
  event.contacts.clear();
  event.body_map_version = 0;
  EXPECT_EQ(validate(event), nullptr);
}

TEST(AFelt, IsRefusedWithTheReason) {
  expect_faults<Felt>(
      example_felt(),
      {
          {"a session is not 32 hexadecimal digits", [](auto& felt) { felt.session = "me"; }},
          {"a session is not 32 hexadecimal digits", [](auto& felt) { felt.touch_session.clear(); }},
          {"the sequence number is 0", [](auto& felt) { felt.touch_sequence = 0; }},
          {"the phase is unknown", [](auto& felt) { felt.phase = Phase{255}; }},
          {"the outcome is unknown", [](auto& felt) { felt.outcome = FeltOutcome{felt_outcome_count}; }},
          {"the box is impossible", [](auto& felt) { felt.box = 0; }},
          {"the box is impossible", [](auto& felt) { felt.box = 10'001; }},
          {"a time is negative", [](auto& felt) { felt.received_time_ns = -1; }},
          {"a time is negative", [](auto& felt) { felt.driven_time_ns = -1; }},
      });
}

TEST(AHeartbeat, IsRefusedWithTheReason) {
  expect_faults<Heartbeat>(
      example_heartbeat(),
      {
          {"the session is not 32 hexadecimal digits", [](auto& beat) { beat.session.clear(); }},
          {"the side is unknown", [](auto& beat) { beat.side = Side{2}; }},
          {"the sequence number is 0", [](auto& beat) { beat.sequence = 0; }},
          {"the echoed session is not 32 hexadecimal digits", [](auto& beat) { beat.echo_session = "you"; }},
          {"a time is negative", [](auto& beat) { beat.sent_time_ns = -1; }},
          {"a time is negative", [](auto& beat) { beat.echo_sent_time_ns = -1; }},
          {"a time is negative", [](auto& beat) { beat.echo_held_ns = -1; }},
      });
  Heartbeat first = example_heartbeat();
  first.echo_session.clear();
  EXPECT_EQ(validate(first), nullptr);
}

TEST(ASideStatus, IsRefusedWithTheReason) {
  constexpr const char* text = "a text is not printable UTF-8";
  expect_faults<SideStatus>(example_status(),
                            {
                                {"the session is not 32 hexadecimal digits", [](auto& s) { s.session.clear(); }},
                                {"the side is unknown", [](auto& s) { s.side = Side{9}; }},
                                {text, [](auto& s) { s.version = "1\n2"; }},
                                {text, [](auto& s) { s.reason = "\x1b[2J"; }},       // clears a terminal
                                {text, [](auto& s) { s.reason = "\xc2\x9b"; }},      // the same in one character
                                {text, [](auto& s) { s.reason = "caf\xe9"; }},       // Latin-1
                                {text, [](auto& s) { s.reason = "\xc0\xaf"; }},      // overlong
                                {text, [](auto& s) { s.reason = "\xed\xa0\x80"; }},  // surrogate
                                {text, [](auto& s) { s.reason = "\xe2\x82"; }},      // cut off
                            });
}

TEST(AStopAll, IsRefusedWithTheReason) {
  expect_faults<StopAll>(example_stop(),
                         {
                             {"the session is not 32 hexadecimal digits", [](auto& stop) { stop.session.clear(); }},
                             {"the side is unknown", [](auto& stop) { stop.side = Side{2}; }},
                             {"the sequence number is 0", [](auto& stop) { stop.sequence = 0; }},
                             {"a text is not printable UTF-8", [](auto& stop) { stop.reason = "\x7f"; }},
                         });
}

TEST(ARenewal, IsRefusedWithTheReason) {
  constexpr const char* missing = "a part of the renewal is missing";
  constexpr const char* too_long = "a part of the renewal is too long";
  constexpr const char* no_text = "a part of the renewal is no plain text";
  expect_faults<PairRenewal>(
      example_renewal(),
      {
          {"the session is not 32 hexadecimal digits", [](auto& renewal) { renewal.session.clear(); }},
          {missing, [](auto& renewal) { renewal.certificate.clear(); }},
          {missing, [](auto& renewal) { renewal.permissions.clear(); }},
          {too_long, [](auto& renewal) { renewal.certificate.append(max_renewed_certificate, 'A'); }},
          {too_long, [](auto& renewal) { renewal.permissions.append(max_renewed_permissions, 'A'); }},
          {no_text, [](auto& renewal) { renewal.certificate += "\x1b[2J"; }},
          {no_text, [](auto& renewal) { renewal.permissions += "caf\xc3\xa9"; }},
          {no_text, [](auto& renewal) { renewal.permissions += "\x7f"; }},
      });
}

TEST(AHug, IsRefusedWithTheReason) {
  constexpr const char* strength = "the strength is not above 0 and up to 1";
  expect_faults<Hug>(example_hug(),
                     {
                         {"the session is not 32 hexadecimal digits", [](auto& hug) { hug.session.clear(); }},
                         {"the sequence number is 0", [](auto& hug) { hug.sequence = 0; }},
                         {"a time is negative", [](auto& hug) { hug.sent_time_ns = -1; }},
                         {strength, [](auto& hug) { hug.strength = 0; }},
                         {strength, [](auto& hug) { hug.strength = 1.01; }},
                         {strength, [](auto& hug) { hug.strength = nan_value; }},
                         {strength, [](auto& hug) { hug.strength = infinite; }},
                     });
}

}  // namespace
}  // namespace telehug
