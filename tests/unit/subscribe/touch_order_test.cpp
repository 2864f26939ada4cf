// SPDX-License-Identifier: Apache-2.0
#include "subscribe/touch_order.hpp"

#include <gtest/gtest.h>

#include "doubles/example_messages.hpp"

namespace telehug {
namespace {

TouchEvent event_number(std::uint64_t sequence, const SessionId& session = example_session) {
  TouchEvent event;
  event.session = session;
  event.sequence = sequence;
  event.body_map_version = 1;
  return event;
}

Transition transition(std::uint64_t sequence, std::uint32_t id, Phase phase) {
  return {.event_sequence = sequence, .frame_time_ns = 0, .contact = example_contact(id, phase)};
}

TEST(TouchOrder, PassesEventsInOrderAndDropsTheRest) {
  TouchOrder order;
  for (const std::uint64_t sequence : {1U, 2U, 5U})
    EXPECT_NE(order.accept(event_number(sequence)), nullptr);
  EXPECT_EQ(order.accept(event_number(5)), nullptr);
  EXPECT_EQ(order.accept(event_number(4)), nullptr);
  EXPECT_EQ(order.accept(event_number(4)), nullptr);
  EXPECT_NE(order.accept(event_number(6)), nullptr);
  const TouchOrderCounters& counters = order.counters();
  EXPECT_EQ(counters.accepted, 4U);
  EXPECT_EQ(counters.duplicates, 2U);
  EXPECT_EQ(counters.overtaken, 1U);
  EXPECT_EQ(counters.lost, 1U) << "number 3; number 4 came late";
}

TEST(TouchOrder, DoesNotCountAsLostWhatWasSentBeforeItListened) {
  TouchOrder order;
  order.accept(event_number(1000));
  EXPECT_EQ(order.accept(event_number(999)), nullptr);
  EXPECT_EQ(order.counters().lost, 0U);
  EXPECT_NE(order.accept(event_number(1001)), nullptr);
  EXPECT_EQ(order.counters().lost, 0U);
}

TEST(TouchOrder, SaysThatANewSessionEndsTheOldOneAndDropsLatePacketsOfIt) {
  TouchOrder order;
  EXPECT_TRUE(order.accept(event_number(700))->new_session);
  EXPECT_FALSE(order.accept(event_number(701))->new_session);
  const TouchEvent restarted = event_number(1, other_session);
  EXPECT_TRUE(order.accept(restarted)->new_session);
  EXPECT_EQ(order.accept(event_number(702)), nullptr);
  EXPECT_FALSE(order.accept(event_number(2, other_session))->new_session);
  EXPECT_EQ(order.counters().retired, 1U);
  EXPECT_EQ(order.counters().sessions, 2U);
}

TEST(TouchOrder, DeliversATapWhoseOwnEventsWereBothLost) {
  TouchOrder order;
  order.accept(event_number(1));
  TouchEvent event = event_number(4);
  event.transitions = {transition(2, 1, Phase::down), transition(3, 1, Phase::up)};
  const OrderedTouch* ordered = order.accept(event);
  ASSERT_EQ(ordered->transitions.size(), 2U);
  EXPECT_EQ(ordered->transitions[0].contact.phase, Phase::down);
  EXPECT_EQ(ordered->transitions[1].contact.phase, Phase::up);
  EXPECT_TRUE(ordered->ended.empty());
  EXPECT_EQ(order.counters().recovered, 2U);

  TouchEvent repeated = event_number(5);
  repeated.transitions = event.transitions;
  EXPECT_TRUE(order.accept(repeated)->transitions.empty());
}

TEST(TouchOrder, DeliversATapThatWasOverBeforeTheFirstEventThatCameThrough) {
  TouchOrder order;
  TouchEvent event = event_number(3);
  event.transitions = {transition(1, 1, Phase::down), transition(2, 1, Phase::up)};
  EXPECT_EQ(order.accept(event)->transitions.size(), 2U);
}

TEST(TouchOrder, EndsAContactWhoseUpIsNotRepeatedAnyMore) {
  TouchOrder order;
  TouchEvent touching = event_number(1);
  touching.contacts = {example_contact(1, Phase::down), example_contact(2, Phase::down)};
  touching.transitions = {transition(1, 1, Phase::down), transition(1, 2, Phase::down)};
  EXPECT_TRUE(order.accept(touching)->ended.empty());

  TouchEvent much_later = event_number(90);
  much_later.contacts = {example_contact(2, Phase::move)};
  const OrderedTouch* ordered = order.accept(much_later);
  ASSERT_EQ(ordered->ended.size(), 1U);
  EXPECT_EQ(ordered->ended[0], 1U);
  const TouchEvent next = event_number(91);
  EXPECT_EQ(order.accept(next)->ended.size(), 1U);
  EXPECT_TRUE(order.accept(event_number(92))->ended.empty());
}

TEST(TouchOrder, DoesNotEndAContactTwiceWhenItsUpCame) {
  TouchOrder order;
  TouchEvent touching = event_number(1);
  touching.contacts = {example_contact(1, Phase::down)};
  touching.transitions = {transition(1, 1, Phase::down)};
  order.accept(touching);
  TouchEvent up = event_number(2);
  up.contacts = {example_contact(1, Phase::up)};
  up.transitions = {transition(1, 1, Phase::down), transition(2, 1, Phase::up)};
  const OrderedTouch* ordered = order.accept(up);
  EXPECT_EQ(ordered->transitions.size(), 1U);
  EXPECT_TRUE(ordered->ended.empty());
  EXPECT_TRUE(order.accept(event_number(3))->ended.empty());
}

TEST(TouchOrder, SurvivesContradictoryEvents) {
  TouchOrder order;
  TouchEvent event = event_number(1);
  for (std::uint32_t id = 1; id <= max_transitions; ++id)
    event.transitions.push_back(transition(1, id, Phase::down));
  const OrderedTouch* ordered = order.accept(event);
  EXPECT_EQ(ordered->transitions.size(), max_transitions);
  EXPECT_EQ(ordered->ended.size(), max_contacts) << "down, but not touching; no more than there are fingers";
  EXPECT_TRUE(order.accept(event_number(2))->ended.empty());
}

}  // namespace
}  // namespace telehug
