// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

#include "common/clock.hpp"
#include "dds/participant.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/inbox.hpp"
#include "doubles/unique_domain.hpp"
#include "peer/session_id.hpp"

namespace telehug {
namespace {

class DdsOnLoopback : public testing::Test {
 protected:
  [[nodiscard]] DdsSettings settings(Side side) const {
    return {.side = side, .domain_id = domain.id(), .partition = domain.partition()};
  }

  template <typename T>
  static bool eventually_matched(const Writer<T>& writer) {
    const auto give_up = std::chrono::steady_clock::now() + 10s;
    while (writer.matched() == 0 && std::chrono::steady_clock::now() < give_up)
      std::this_thread::sleep_for(2ms);
    return writer.matched() > 0;
  }

  // Best effort, and the reader may not know of the writer yet when the writer knows of the reader: say it until heard.
  template <typename T>
  static bool write_until_heard(Writer<T>& writer, const T& message, Inbox<T>& inbox, std::size_t count = 1) {
    const auto give_up = std::chrono::steady_clock::now() + 10s;
    while (std::chrono::steady_clock::now() < give_up) {
      if (!writer.write(message)) return false;
      if (inbox.wait_for(count, 20ms)) return true;
    }
    return false;
  }

  template <typename T>
  bool every_restart_is_heard(T message) {
    Inbox<T> inbox;
    const Reader<T> reader(passive, inbox.callback());
    std::vector<std::unique_ptr<Writer<T>>> crashed;  // not destroyed: nobody says farewell in a crash
    for (int restart = 1; restart <= 15; ++restart) {
      Writer<T>& writer = *crashed.emplace_back(std::make_unique<Writer<T>>(active));
      message.session = new_session_id();
      if (!write_until_heard(writer, message, inbox, inbox.messages().size() + 1)) return false;
    }
    return true;
  }

  UniqueDomain domain;
  DdsParticipant active{settings(Side::active)};
  DdsParticipant passive{settings(Side::passive)};
};

TEST_F(DdsOnLoopback, TouchesFlowFromTheActiveToThePassiveSide) {
  Inbox<TouchEvent> inbox;
  const Reader<TouchEvent> reader(passive, inbox.callback());
  Writer<TouchEvent> writer(active);
  const TouchEvent event = example_touch();
  ASSERT_TRUE(write_until_heard(writer, event, inbox));
  const TouchEvent received = inbox.messages().front();
  EXPECT_EQ(received.session, event.session);
  EXPECT_EQ(received.sequence, event.sequence);
  ASSERT_EQ(received.contacts.size(), event.contacts.size());
  EXPECT_DOUBLE_EQ(received.contacts[0].body.x_fh, event.contacts[0].body.x_fh);
  EXPECT_EQ(received.transitions.size(), event.transitions.size());
  EXPECT_GE(reader.counters().received, 1U);
}

TEST_F(DdsOnLoopback, EveryFeltArrivesInOrder) {
  Inbox<Felt> inbox;
  const Reader<Felt> reader(active, inbox.callback());
  Writer<Felt> writer(passive);
  ASSERT_TRUE(eventually_matched(writer));

  Felt felt = example_felt();
  constexpr std::size_t count = 500;
  for (felt.touch_sequence = 1; felt.touch_sequence <= count; ++felt.touch_sequence) {
    ASSERT_TRUE(writer.write(felt));
    // Not faster than they are taken: what is ahead by more than the history may be dropped.
    if (felt.touch_sequence % 32 == 0) {
      ASSERT_TRUE(inbox.wait_for(felt.touch_sequence));
    }
  }
  ASSERT_TRUE(inbox.wait_for(count));
  std::uint64_t expected = 1;
  for (const Felt& received : inbox.messages())
    EXPECT_EQ(received.touch_sequence, expected++);
}

TEST_F(DdsOnLoopback, AHugReachesWhoIsThereAndNobodyWhoJoinsLater) {
  Inbox<Hug> inbox;
  const Reader<Hug> reader(active, inbox.callback());
  Writer<Hug> writer(passive);
  ASSERT_TRUE(eventually_matched(writer));
  Hug hug = example_hug();
  ASSERT_TRUE(writer.write(hug));
  ASSERT_TRUE(inbox.wait_for(1));
  EXPECT_EQ(inbox.messages().front().sequence, hug.sequence);
  EXPECT_EQ(inbox.messages().front().strength, hug.strength);

  Inbox<Hug> late;
  const Reader<Hug> late_reader(active, late.callback());
  ++hug.sequence;
  ASSERT_TRUE(write_until_heard(writer, hug, late));
  EXPECT_EQ(late.messages().front().sequence, hug.sequence);
}

TEST_F(DdsOnLoopback, ASideThatJoinsLateLearnsTheOthersStatusAndStop) {
  Writer<SideStatus> status_writer(active);
  Writer<StopAll> stop_writer(active);
  SideStatus old = example_status();
  old.reason = "an older one";
  ASSERT_TRUE(status_writer.write(old));
  ASSERT_TRUE(status_writer.write(example_status()));
  ASSERT_TRUE(stop_writer.write(example_stop()));

  Inbox<SideStatus> statuses;
  Inbox<StopAll> stops;
  const Reader<SideStatus> status_reader(passive, statuses.callback());
  const Reader<StopAll> stop_reader(passive, stops.callback());
  ASSERT_TRUE(statuses.wait_for(1));
  EXPECT_EQ(statuses.messages().front().reason, example_status().reason);
  ASSERT_TRUE(stops.wait_for(1));
  EXPECT_TRUE(stops.messages().front().stop);
}

TEST_F(DdsOnLoopback, HeartbeatsGoBothWaysAndNoSideHearsItself) {
  Inbox<Heartbeat> at_active;
  Inbox<Heartbeat> at_passive;
  const Reader<Heartbeat> active_reader(active, at_active.callback());
  const Reader<Heartbeat> passive_reader(passive, at_passive.callback());
  Writer<Heartbeat> active_writer(active);
  Writer<Heartbeat> passive_writer(passive);
  Heartbeat answer = example_heartbeat();
  answer.side = Side::passive;
  answer.session = other_session;
  ASSERT_TRUE(write_until_heard(active_writer, example_heartbeat(), at_passive));
  ASSERT_TRUE(write_until_heard(passive_writer, answer, at_active));
  EXPECT_EQ(active_writer.matched(), 1);
  for (const Heartbeat& heard : at_active.messages())
    EXPECT_EQ(heard.session, other_session);
  for (const Heartbeat& heard : at_passive.messages())
    EXPECT_EQ(heard.session, example_session);
}

TEST_F(DdsOnLoopback, AMessageThatClaimsToComeFromTheOtherSideIsDropped) {
  Inbox<Heartbeat> inbox;
  const Reader<Heartbeat> reader(passive, inbox.callback());
  Writer<Heartbeat> writer(active);
  ASSERT_TRUE(write_until_heard(writer, example_heartbeat(), inbox));
  Heartbeat forged = example_heartbeat();
  forged.side = Side::passive;
  ASSERT_TRUE(writer.write(forged));
  ASSERT_TRUE(write_until_heard(writer, example_heartbeat(), inbox, inbox.messages().size() + 1));
  for (const Heartbeat& heard : inbox.messages())
    EXPECT_EQ(heard.side, Side::active);
  EXPECT_EQ(reader.counters().invalid, 1U);
  EXPECT_STREQ(reader.counters().last_fault, "it claims to come from the other side");
}

TEST_F(DdsOnLoopback, AnInvalidMessageIsNotSent) {
  Writer<TouchEvent> writer(active);
  TouchEvent event = example_touch();
  event.contacts[0].box = 21;
  EXPECT_FALSE(writer.write(event));
}

// Fast DDS keeps an instance for each session it ever heard until its writer is known to be gone, by default only ten.
TEST_F(DdsOnLoopback, ASenderMayCrashAndRestartMoreOftenThanFastDdsHasInstancesByDefault) {
  EXPECT_TRUE(every_restart_is_heard(example_touch()));
  EXPECT_TRUE(every_restart_is_heard(example_heartbeat()));
  EXPECT_TRUE(every_restart_is_heard(example_status()));
  EXPECT_TRUE(every_restart_is_heard(example_stop()));
  EXPECT_TRUE(every_restart_is_heard(example_hug()));
}

TEST_F(DdsOnLoopback, AnotherPartitionHearsNothing) {
  DdsSettings elsewhere = settings(Side::passive);
  elsewhere.partition += "-not";
  DdsParticipant stranger(elsewhere);
  Inbox<TouchEvent> strange;
  Inbox<TouchEvent> inbox;
  const Reader<TouchEvent> stranger_reader(stranger, strange.callback());
  Writer<TouchEvent> writer(active);
  const Reader<TouchEvent> reader(passive, inbox.callback());
  ASSERT_TRUE(write_until_heard(writer, example_touch(), inbox));
  EXPECT_EQ(writer.matched(), 1);
  EXPECT_TRUE(strange.messages().empty());
}

TEST_F(DdsOnLoopback, WritersAndReadersOutliveTheirParticipant) {
  auto passing = std::make_unique<DdsParticipant>(settings(Side::active));
  Writer<TouchEvent> writer(*passing);
  passing.reset();
  EXPECT_TRUE(writer.write(example_touch()));
}

TEST(DdsSettings, ThatCannotWorkAreRefusedWithASentence) {
  EXPECT_THROW(DdsParticipant({.domain_id = 101}), std::invalid_argument);
  EXPECT_THROW(DdsParticipant({.partition = ""}), std::invalid_argument);
  EXPECT_THROW(DdsParticipant({.partition = "*"}), std::invalid_argument);
  EXPECT_THROW(DdsParticipant({.loopback_only = true, .peers = {"192.0.2.7"}}), std::invalid_argument);
  EXPECT_THROW(DdsParticipant({.loopback_only = false, .peers = {"grandma"}}), std::invalid_argument);
}

}  // namespace
}  // namespace telehug
