// SPDX-License-Identifier: Apache-2.0
#include "dds/wire.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "doubles/example_messages.hpp"

namespace telehug {
namespace {

template <typename T, typename Wire>
T there_and_back(const T& message, Wire wire) {
  to_wire(message, wire);
  T back;
  EXPECT_EQ(from_wire(wire, back), nullptr);
  return back;
}

void expect_equal(const Contact& a, const Contact& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.phase, b.phase);
  EXPECT_EQ(a.box, b.box);
  EXPECT_EQ(a.grid, b.grid);
  EXPECT_EQ(a.body.x_fh, b.body.x_fh);
  EXPECT_EQ(a.body.y_fh, b.body.y_fh);
  EXPECT_EQ(a.screen.x_mm, b.screen.x_mm);
  EXPECT_EQ(a.screen.y_mm, b.screen.y_mm);
  EXPECT_EQ(a.speed_mm_s, b.speed_mm_s);
  EXPECT_EQ(a.strength, b.strength);
  EXPECT_EQ(a.gesture, b.gesture);
}

TEST(TheWireForm, KeepsEveryFieldOfATouchEvent) {
  const TouchEvent event = example_touch();
  const TouchEvent back = there_and_back(event, v1::TouchEvent());
  EXPECT_EQ(back.session, event.session);
  EXPECT_EQ(back.sequence, event.sequence);
  EXPECT_EQ(back.frame_time_ns, event.frame_time_ns);
  EXPECT_EQ(back.sent_time_ns, event.sent_time_ns);
  EXPECT_EQ(back.body_map_version, event.body_map_version);
  ASSERT_EQ(back.contacts.size(), event.contacts.size());
  for (std::size_t i = 0; i < event.contacts.size(); ++i)
    expect_equal(back.contacts[i], event.contacts[i]);
  ASSERT_EQ(back.transitions.size(), event.transitions.size());
  for (std::size_t i = 0; i < event.transitions.size(); ++i) {
    EXPECT_EQ(back.transitions[i].event_sequence, event.transitions[i].event_sequence);
    EXPECT_EQ(back.transitions[i].frame_time_ns, event.transitions[i].frame_time_ns);
    expect_equal(back.transitions[i].contact, event.transitions[i].contact);
  }
}

TEST(TheWireForm, KeepsEveryFieldOfAFelt) {
  const Felt felt = example_felt();
  const Felt back = there_and_back(felt, v1::Felt());
  EXPECT_EQ(back.session, felt.session);
  EXPECT_EQ(back.touch_session, felt.touch_session);
  EXPECT_EQ(back.touch_sequence, felt.touch_sequence);
  EXPECT_EQ(back.contact_id, felt.contact_id);
  EXPECT_EQ(back.phase, felt.phase);
  EXPECT_EQ(back.box, felt.box);
  EXPECT_EQ(back.outcome, felt.outcome);
  EXPECT_EQ(back.actuators, felt.actuators);
  EXPECT_EQ(back.received_time_ns, felt.received_time_ns);
  EXPECT_EQ(back.driven_time_ns, felt.driven_time_ns);
}

TEST(TheWireForm, KeepsEveryFieldOfAHeartbeat) {
  Heartbeat heartbeat = example_heartbeat();
  heartbeat.side = Side::passive;
  const Heartbeat back = there_and_back(heartbeat, v1::Heartbeat());
  EXPECT_EQ(back.session, heartbeat.session);
  EXPECT_EQ(back.side, heartbeat.side);
  EXPECT_EQ(back.sequence, heartbeat.sequence);
  EXPECT_EQ(back.sent_time_ns, heartbeat.sent_time_ns);
  EXPECT_EQ(back.echo_session, heartbeat.echo_session);
  EXPECT_EQ(back.echo_sent_time_ns, heartbeat.echo_sent_time_ns);
  EXPECT_EQ(back.echo_held_ns, heartbeat.echo_held_ns);
  heartbeat.echo_session.clear();
  EXPECT_TRUE(there_and_back(heartbeat, v1::Heartbeat()).echo_session.empty());
}

TEST(TheWireForm, KeepsEveryFieldOfAStatusAndAStop) {
  const SideStatus status = example_status();
  const SideStatus back = there_and_back(status, v1::SideStatus());
  EXPECT_EQ(back.session, status.session);
  EXPECT_EQ(back.side, status.side);
  EXPECT_EQ(back.version, status.version);
  EXPECT_EQ(back.ready, status.ready);
  EXPECT_EQ(back.stopped, status.stopped);
  EXPECT_EQ(back.reason, status.reason);

  const StopAll stop = example_stop();
  const StopAll stop_back = there_and_back(stop, v1::StopAll());
  EXPECT_EQ(stop_back.session, stop.session);
  EXPECT_EQ(stop_back.side, stop.side);
  EXPECT_EQ(stop_back.sequence, stop.sequence);
  EXPECT_EQ(stop_back.stop, stop.stop);
  EXPECT_EQ(stop_back.reason, stop.reason);
}

TEST(TheWireForm, KeepsEveryFieldOfARenewal) {
  PairRenewal renewal = example_renewal();
  for (const std::size_t more : {std::size_t{0}, max_renewed_certificate - renewal.certificate.size()}) {
    renewal.certificate.append(more, 'A');
    renewal.permissions.append(2 * more, 'B');
    const PairRenewal back = there_and_back(renewal, v1::PairRenewal());
    EXPECT_EQ(back.session, renewal.session);
    EXPECT_EQ(back.certificate, renewal.certificate);
    EXPECT_EQ(back.permissions, renewal.permissions);
  }
}

TEST(TheWireForm, KeepsEveryFieldOfAHug) {
  const Hug hug = example_hug();
  const Hug back = there_and_back(hug, v1::Hug());
  EXPECT_EQ(back.session, hug.session);
  EXPECT_EQ(back.sequence, hug.sequence);
  EXPECT_EQ(back.sent_time_ns, hug.sent_time_ns);
  EXPECT_EQ(back.strength, hug.strength);
}

TEST(TheWireForm, LeavesNothingOfALongerTextBehindAShorterOne) {
  SideStatus status = example_status();
  v1::SideStatus wire;
  to_wire(status, wire);
  for (const char* reason : {"short", ""}) {
    status.reason = reason;
    to_wire(status, wire);
    SideStatus back;
    EXPECT_EQ(from_wire(wire, back), nullptr);
    EXPECT_EQ(back.reason, reason);
  }
}

TEST(TheWireForm, CutsTextsThatAreTooLongBetweenTwoCharacters) {
  SideStatus status = example_status();
  status.reason = std::string(254, 'a') + "\u00e4\u00e4";  // the first of them lies over the end
  status.version = std::string(40, '1');
  const SideStatus back = there_and_back(status, v1::SideStatus());
  EXPECT_EQ(back.reason, std::string(254, 'a'));
  EXPECT_EQ(back.version, std::string(32, '1'));
  status.reason = std::string(253, 'a') + "\u00e4\u00e4";
  EXPECT_EQ(there_and_back(status, v1::SideStatus()).reason, std::string(253, 'a') + "\u00e4");
}

TEST(TheWireForm, IsReusedWithoutTracesOfTheMessageBefore) {
  v1::TouchEvent wire;
  TouchEvent back;
  to_wire(example_touch(), wire);
  ASSERT_EQ(from_wire(wire, back), nullptr);
  TouchEvent empty;
  empty.session = other_session;
  empty.sequence = 1;
  to_wire(empty, wire);
  ASSERT_EQ(from_wire(wire, back), nullptr);
  EXPECT_TRUE(back.contacts.empty());
  EXPECT_TRUE(back.transitions.empty());
  EXPECT_EQ(back.session, other_session);
}

// Fast DDS enforces neither on receipt.
TEST(TheWireForm, IsRefusedBeyondItsBoundsAndWithUnknownEnums) {
  v1::TouchEvent wire;
  TouchEvent event;
  to_wire(example_touch(), wire);
  v1::TouchEvent crowded = wire;
  crowded.contacts().resize(11);
  EXPECT_STREQ(from_wire(crowded, event), "there are more contacts than fingers");
  crowded = wire;
  crowded.transitions().resize(17);
  EXPECT_STREQ(from_wire(crowded, event), "there are too many transitions");
  for (const std::uint32_t unknown : {3U, 99U, 256U, 258U, 0xFFFFFFFFU}) {
    v1::TouchEvent strange = wire;
    strange.contacts()[0].phase(static_cast<v1::Phase>(unknown));
    EXPECT_STREQ(from_wire(strange, event), "a contact's phase is unknown") << unknown;
    strange = wire;
    strange.transitions()[0].contact().gesture(static_cast<v1::Gesture>(std::max(unknown, 6U)));
    EXPECT_STREQ(from_wire(strange, event), "a contact's gesture is unknown") << unknown;
  }
  v1::Felt wire_felt;
  Felt felt;
  to_wire(example_felt(), wire_felt);
  wire_felt.actuators().resize(17);
  EXPECT_STREQ(from_wire(wire_felt, felt), "there are too many actuators");
  PairRenewal long_one = example_renewal();
  long_one.certificate.append(max_renewed_certificate, 'A');
  v1::PairRenewal wire_renewal;
  to_wire(long_one, wire_renewal);
  EXPECT_EQ(wire_renewal.certificate().size(), max_renewed_certificate);
  wire.session({});
  EXPECT_STREQ(from_wire(wire, event), "the session is not 32 hexadecimal digits");
}

}  // namespace
}  // namespace telehug
