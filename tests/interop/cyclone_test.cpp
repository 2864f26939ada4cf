// SPDX-License-Identifier: Apache-2.0
//
// telehug's wire is what idl/README.md says: a program on another DDS implementation, generated from the same IDL,
// understands each value, and what it says is understood. Plain, on loopback.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "dds/participant.hpp"
#include "dds/reader.hpp"
#include "dds/validate.hpp"
#include "dds/writer.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/inbox.hpp"
#include "doubles/unique_domain.hpp"
#include "interop/cyclone_peer.hpp"
#include "interop/message_json.hpp"

namespace telehug {
namespace {

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
constexpr std::int64_t latest = std::numeric_limits<std::int64_t>::max();
const SessionId all_ones = "ffffffffffffffffffffffffffffffff";
const SessionId wearers_session = "00112233445566778899aabbccddeeff";

Contact greatest_contact(std::uint32_t id, Phase phase) {
  constexpr std::uint16_t side = max_grid_boxes_per_side;
  return {.id = std::numeric_limits<std::uint32_t>::max() - id,
          .phase = phase,
          .box = side * side,
          .grid = {.columns = side, .rows = side},
          .body = {.x_fh = -max_body_fh, .y_fh = max_body_fh},
          .screen = {.x_mm = max_screen_mm, .y_mm = -max_screen_mm},
          .speed_mm_s = max_speed_mm_s,
          .strength = 1,
          .gesture = Gesture::hug};
}

TouchEvent empty_touch() {
  TouchEvent event;
  event.session = example_session;
  event.sequence = 1;
  return event;
}

TouchEvent greatest_touch() {
  TouchEvent event;
  event.session = all_ones;
  event.sequence = most;
  event.frame_time_ns = latest;
  event.sent_time_ns = latest;
  event.body_map_version = std::numeric_limits<std::uint32_t>::max();
  for (std::uint32_t i = 0; i < max_contacts; ++i)
    event.contacts.push_back(greatest_contact(i, static_cast<Phase>(i % 3)));
  for (std::uint32_t i = 0; i < max_transitions; ++i) {
    event.transitions.push_back({.event_sequence = most - max_transitions + 1 + i,
                                 .frame_time_ns = latest - i,
                                 .contact = greatest_contact(i, i % 2 == 0 ? Phase::down : Phase::up)});
  }
  return event;
}

// Numbers that show a wrong width, order of bytes or alignment; doubles that only their own 64 bits can hold.
TouchEvent telling_touch() {
  TouchEvent event;
  event.session = "0102030405060708090a0b0c0d0e0f10";
  event.sequence = 0x0102030405060708;
  event.frame_time_ns = 0x1112131415161718;
  event.sent_time_ns = 0x2122232425262728;
  event.body_map_version = 0x31323334;
  event.contacts.push_back({.id = 0x41424344,
                            .phase = Phase::move,
                            .box = 0x0102,
                            .grid = {.columns = 99, .rows = 3},
                            .body = {.x_fh = 0.1, .y_fh = -1.0 / 3},
                            .screen = {.x_mm = 5e-324, .y_mm = 2.2250738585072014e-308},
                            .speed_mm_s = 99'999.999'999'999'99,
                            .strength = 0.999'999'999'999'999'9,
                            .gesture = Gesture::pat});
  return event;
}

// Each phase with each gesture; ten to an event.
std::vector<TouchEvent> every_phase_and_gesture() {
  std::vector<TouchEvent> events;
  std::uint32_t id = 0;
  for (const Phase phase : {Phase::down, Phase::move, Phase::up}) {
    for (std::uint8_t gesture = 0; gesture < gesture_count; ++gesture) {
      if (id % max_contacts == 0) {
        events.push_back(empty_touch());
        events.back().sequence = 2 + id;
        events.back().body_map_version = 1;
      }
      Contact contact = example_contact(++id, phase);
      contact.gesture = static_cast<Gesture>(gesture);
      events.back().contacts.push_back(contact);
      if (phase != Phase::move) events.back().transitions.push_back({.event_sequence = 1, .contact = contact});
    }
  }
  return events;
}

std::vector<TouchEvent> golden_touches() {
  std::vector<TouchEvent> events = every_phase_and_gesture();
  events.insert(events.begin(), empty_touch());
  events.insert(events.end(), {example_touch(), telling_touch(), greatest_touch()});
  return events;
}

// What cyclone/wearer_side.c answers a contact with.
Felt expected_felt(const TouchEvent& event, std::size_t number) {
  Felt felt;
  felt.session = wearers_session;
  felt.touch_session = event.session;
  felt.touch_sequence = event.sequence;
  felt.contact_id = event.contacts[number].id;
  felt.phase = event.contacts[number].phase;
  felt.box = event.contacts[number].box;
  felt.outcome = static_cast<FeltOutcome>(number % felt_outcome_count);
  for (std::size_t i = 0; i < std::min(2 * number, max_felt_actuators); ++i)
    felt.actuators.push_back(static_cast<std::uint8_t>(255 - i));
  felt.received_time_ns = event.sent_time_ns;
  felt.driven_time_ns = event.frame_time_ns;
  return felt;
}

void expect_same(const Felt& felt, const Felt& expected) {
  EXPECT_EQ(felt.session, expected.session);
  EXPECT_EQ(felt.touch_session, expected.touch_session);
  EXPECT_EQ(felt.touch_sequence, expected.touch_sequence);
  EXPECT_EQ(felt.contact_id, expected.contact_id);
  EXPECT_EQ(felt.phase, expected.phase);
  EXPECT_EQ(felt.box, expected.box);
  EXPECT_EQ(felt.outcome, expected.outcome);
  EXPECT_EQ(felt.actuators, expected.actuators);
  EXPECT_EQ(felt.received_time_ns, expected.received_time_ns);
  EXPECT_EQ(felt.driven_time_ns, expected.driven_time_ns);
}

// Says it again and again until it is heard: best effort, so what is said before both sides know each other is lost.
template <typename T, typename Heard>
bool repeat_until(Writer<T>& writer, T message, const Heard& heard) {
  const auto give_up = std::chrono::steady_clock::now() + 20s;
  while (std::chrono::steady_clock::now() < give_up) {
    ++message.sequence;
    if (!writer.write(message)) return false;
    if (heard(20ms)) return true;
  }
  return false;
}

class CycloneInterop : public testing::Test {
 protected:
  // Until each hears the other, and all that was said for it has come back.
  void meet() {
    TouchEvent hello = empty_touch();
    hello.sequence = 1'000'000;
    hello.body_map_version = 1;
    hello.contacts.push_back(example_contact(7));
    ASSERT_TRUE(repeat_until(touches, hello, [this](Duration patience) { return felt.wait_for(1, patience); }))
        << "the two never met";
    hello.sequence = 2'000'000;
    ASSERT_TRUE(touches.write(hello));
    ASSERT_FALSE(wearer.next("touch", hello.sequence).is_null());
    ASSERT_TRUE(felt.wait_until([&](const auto& all) { return all.back().touch_sequence == hello.sequence; }));
  }

  UniqueDomain domain;
  DdsParticipant active{{.side = Side::active, .domain_id = domain.id(), .partition = domain.partition()}};
  Writer<TouchEvent> touches{active};
  Writer<Heartbeat> heartbeats{active};
  Writer<SideStatus> statuses{active};
  Writer<StopAll> stops{active};
  Inbox<Felt> felt;
  Inbox<Heartbeat> heard_heartbeats;
  Inbox<SideStatus> heard_statuses;
  Inbox<StopAll> heard_stops;
  Reader<Felt> felt_reader{active, felt.callback()};
  Reader<Heartbeat> heartbeat_reader{active, heard_heartbeats.callback()};
  Reader<SideStatus> status_reader{active, heard_statuses.callback()};
  Reader<StopAll> stop_reader{active, heard_stops.callback()};
  CycloneWearer wearer{domain.id(), domain.partition(), wearers_session};
};

TEST_F(CycloneInterop, EveryValueOfATouchIsUnderstoodAndWhatWasFeltOfItIsUnderstoodHere) {
  ASSERT_NO_FATAL_FAILURE(meet());
  std::size_t answers = felt.messages().size();
  for (const TouchEvent& event : golden_touches()) {
    ASSERT_EQ(validate(event), nullptr);
    ASSERT_TRUE(touches.write(event));
    EXPECT_EQ(wearer.next("touch"), as_printed(event));
    ASSERT_TRUE(felt.wait_for(answers + event.contacts.size()));
    for (std::size_t i = 0; i < event.contacts.size(); ++i)
      expect_same(felt.messages()[answers + i], expected_felt(event, i));
    answers += event.contacts.size();
  }
  EXPECT_EQ(felt.messages().size(), answers);
  EXPECT_EQ(felt_reader.counters().malformed, 0U);
  EXPECT_EQ(felt_reader.counters().invalid, 0U);
}

TEST_F(CycloneInterop, HeartbeatsAreUnderstoodInBothDirections) {
  Heartbeat first = example_heartbeat();
  first.sequence = 1'000'000;
  first.echo_session.clear();
  ASSERT_TRUE(
      repeat_until(heartbeats, first, [this](Duration patience) { return heard_heartbeats.wait_for(1, patience); }));
  const Heartbeat greatest{.session = all_ones,
                           .side = Side::active,
                           .sequence = most,
                           .sent_time_ns = latest,
                           .echo_session = all_ones,
                           .echo_sent_time_ns = latest,
                           .echo_held_ns = latest};
  first.sequence = most - 1;
  first.sent_time_ns = 101;
  std::uint64_t answers = 0;
  for (const Heartbeat& said : {first, greatest}) {
    ASSERT_TRUE(heartbeats.write(said));
    EXPECT_EQ(wearer.next("heartbeat", said.sequence), as_printed(said));
    ASSERT_TRUE(heard_heartbeats.wait_until(
        [&](const auto& all) { return all.back().echo_sent_time_ns == said.sent_time_ns; }));
    const Heartbeat answer = heard_heartbeats.messages().back();
    EXPECT_EQ(answer.session, wearers_session);
    EXPECT_EQ(answer.side, Side::passive);
    EXPECT_GT(answer.sequence, answers);
    answers = answer.sequence;
    EXPECT_EQ(answer.sent_time_ns, said.sent_time_ns);
    EXPECT_EQ(answer.echo_session, said.session);
    EXPECT_EQ(answer.echo_sent_time_ns, said.sent_time_ns);
    EXPECT_EQ(answer.echo_held_ns, 1);
  }
  EXPECT_EQ(heartbeat_reader.counters().malformed + heartbeat_reader.counters().invalid, 0U);
}

TEST_F(CycloneInterop, StatusAndStopAreUnderstoodInBothDirectionsWithTextsOfAnyLength) {
  // As long as the wire allows: 32 and 255 bytes.
  const std::string longest_version(32, 'v');
  const std::string longest_reason = "\"\\ \u00bbC920\u00ab \u20ac \U0001F917 " + std::string(234, 'r');
  ASSERT_EQ(longest_reason.size(), 255U);
  std::size_t answers = 0;
  for (const auto& [version, reason] :
       {std::pair<std::string, std::string>{"", ""}, {longest_version, longest_reason}, {"0.1.0", "short again"}}) {
    const SideStatus status{.session = example_session,
                            .side = Side::active,
                            .version = version,
                            .ready = answers % 2 == 0,
                            .stopped = answers % 2 == 1,
                            .reason = reason};
    const StopAll stop{.session = example_session,
                       .side = Side::active,
                       .sequence = most - answers,
                       .stop = answers % 2 == 0,
                       .reason = reason};
    // Both are latched: nobody needs to know the other side yet.
    ASSERT_TRUE(statuses.write(status));
    ASSERT_TRUE(stops.write(stop));
    ++answers;
    EXPECT_EQ(wearer.next("status"), as_printed(status));
    EXPECT_EQ(wearer.next("stop"), as_printed(stop));
    ASSERT_TRUE(heard_stops.wait_for(answers));
    ASSERT_TRUE(heard_statuses.wait_for(answers));
    const SideStatus status_back = heard_statuses.messages().back();
    EXPECT_EQ(status_back.session, wearers_session);
    EXPECT_EQ(status_back.side, Side::passive);
    EXPECT_EQ(status_back.version, status.version);
    EXPECT_EQ(status_back.ready, status.ready);
    EXPECT_EQ(status_back.stopped, status.stopped);
    EXPECT_EQ(status_back.reason, status.reason);
    const StopAll stop_back = heard_stops.messages().back();
    EXPECT_EQ(stop_back.session, wearers_session);
    EXPECT_EQ(stop_back.side, Side::passive);
    EXPECT_EQ(stop_back.sequence, stop.sequence);
    EXPECT_EQ(stop_back.stop, stop.stop);
    EXPECT_EQ(stop_back.reason, stop.reason);
  }
}

// Built from an IDL of its own under our type names: Cyclone DDS lets it write that, and the two match.
TEST(ASenderOfAnotherVersion, IsCountedAndDropped) {
  const UniqueDomain domain;
  DdsParticipant passive({.side = Side::passive, .domain_id = domain.id(), .partition = domain.partition()});
  Inbox<TouchEvent> touches;
  Inbox<Heartbeat> heartbeats;
  const Reader<TouchEvent> touch_reader(passive, touches.callback());
  const Reader<Heartbeat> heartbeat_reader(passive, heartbeats.callback());
  const ChildProgram strange = cyclone_program("another_version", domain.id(), domain.partition(), "99");

  const auto give_up = std::chrono::steady_clock::now() + 20s;
  const auto both_counted = [&] {
    return touch_reader.counters().malformed > 0 && heartbeat_reader.counters().invalid > 0;
  };
  while (!both_counted() && std::chrono::steady_clock::now() < give_up)
    (void)touches.wait_for(1, 20ms);
  EXPECT_GT(touch_reader.counters().malformed, 0U) << "touches that end too early";
  EXPECT_EQ(touch_reader.counters().invalid, 0U);
  EXPECT_GT(heartbeat_reader.counters().invalid, 0U) << "heartbeats of side 99";
  EXPECT_EQ(heartbeat_reader.counters().malformed, 0U);
  EXPECT_STREQ(heartbeat_reader.counters().last_fault, "the side is unknown");
  EXPECT_TRUE(touches.messages().empty());
  EXPECT_TRUE(heartbeats.messages().empty());

  // The readers are none the worse for it: whoever speaks our version is heard beside it.
  DdsParticipant active({.side = Side::active, .domain_id = domain.id(), .partition = domain.partition()});
  Writer<TouchEvent> own(active);
  EXPECT_TRUE(repeat_until(own, example_touch(), [&](Duration patience) { return touches.wait_for(1, patience); }));
}

}  // namespace
}  // namespace telehug
