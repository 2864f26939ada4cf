// SPDX-License-Identifier: Apache-2.0
#include "publish/touch_event_builder.hpp"

#include <gtest/gtest.h>

#include "doubles/allocation_counter.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

constexpr GridShape grid{.columns = 5, .rows = 4};

BoxedContact boxed(std::uint32_t id, Phase phase, std::uint16_t box = 7) {
  return {.id = id,
          .phase = phase,
          .screen = {.x_mm = 10, .y_mm = 20},
          .speed_mm_s = 3,
          .grid = grid,
          .box = box,
          .body = {.x_fh = 0.5, .y_fh = 1}};
}

class TouchEvents : public testing::Test {
 protected:
  // One frame, 33 ms after the one before.
  const TouchEvent* frame(const BoxedContacts& contacts) {
    clock.advance(33ms);
    return builder.build(contacts, 4, clock.now(), clock.now() + 5ms);
  }

  FakeClock clock;
  TouchEventBuilder builder{example_session};
};

TEST_F(TouchEvents, AreNotSentWhenNobodyTouches) {
  EXPECT_EQ(frame({}), nullptr);
}

TEST_F(TouchEvents, CarryTheWholeStateAndWhereItComesFrom) {
  const TouchEvent* event = frame({boxed(1, Phase::down), boxed(2, Phase::down, 9)});
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->session, example_session);
  EXPECT_EQ(event->sequence, 1U);
  EXPECT_EQ(event->body_map_version, 4U);
  EXPECT_EQ(event->frame_time_ns, to_ns(clock.now()));
  EXPECT_EQ(event->sent_time_ns, to_ns(clock.now() + 5ms));
  ASSERT_EQ(event->contacts.size(), 2U);
  const Contact& second = event->contacts[1];
  EXPECT_EQ(second.id, 2U);
  EXPECT_EQ(second.phase, Phase::down);
  EXPECT_EQ(second.box, 9);
  EXPECT_EQ(second.grid, grid);
  EXPECT_EQ(second.body.y_fh, 1);
  EXPECT_EQ(second.screen.y_mm, 20);
  EXPECT_EQ(second.speed_mm_s, 3);
  EXPECT_EQ(second.strength, 1);
  EXPECT_EQ(frame({boxed(1, Phase::move), boxed(2, Phase::move)})->sequence, 2U);
}

TEST_F(TouchEvents, RepeatTheFinalGestureWithTheUp) {
  frame({boxed(1, Phase::down)});
  BoxedContact stroke = boxed(1, Phase::up);
  stroke.gesture = Gesture::stroke;
  EXPECT_EQ(frame({stroke})->contacts[0].gesture, Gesture::stroke);
  EXPECT_EQ(frame({})->transitions[1].contact.gesture, Gesture::stroke);
}

TEST_F(TouchEvents, EndAContactThatSlidOutAsWhatItWasUntilThen) {
  BoxedContact stroke = boxed(1, Phase::down);
  stroke.gesture = Gesture::stroke;
  frame({stroke});
  EXPECT_EQ(frame({})->transitions[1].contact.gesture, Gesture::stroke);
}

TEST_F(TouchEvents, SendAnUpOnceAsAContactAndThenOnlyAsATransition) {
  frame({boxed(1, Phase::down)});
  const TouchEvent* up = frame({boxed(1, Phase::up)});
  ASSERT_EQ(up->contacts.size(), 1U);
  EXPECT_EQ(up->contacts[0].phase, Phase::up);
  const TouchEvent* after = frame({});
  ASSERT_NE(after, nullptr);
  EXPECT_TRUE(after->contacts.empty());
  ASSERT_EQ(after->transitions.size(), 2U);
  EXPECT_EQ(after->transitions[1].contact.phase, Phase::up);
  EXPECT_EQ(after->transitions[1].event_sequence, 2U);
}

TEST_F(TouchEvents, RepeatEachTransitionEightTimesAndThenFallSilent) {
  int downs = 0;
  int ups = 0;
  const auto count = [&](const TouchEvent* event) {
    for (const Transition& transition : event->transitions)
      (transition.contact.phase == Phase::down ? downs : ups) += 1;
  };
  count(frame({boxed(1, Phase::down)}));
  count(frame({boxed(1, Phase::up)}));
  int silent_after = 0;
  while (const TouchEvent* event = frame({})) {
    count(event);
    ++silent_after;
  }
  EXPECT_EQ(downs, 9);
  EXPECT_EQ(ups, 9);
  EXPECT_EQ(silent_after, 8);
  EXPECT_EQ(frame({}), nullptr);
}

TEST_F(TouchEvents, StopRepeatingATransitionThatIsHalfASecondOld) {
  frame({boxed(1, Phase::down)});
  clock.advance(400ms);
  EXPECT_EQ(frame({boxed(1, Phase::move)})->transitions.size(), 1U);
  clock.advance(40ms);
  EXPECT_TRUE(frame({boxed(1, Phase::move)})->transitions.empty());
}

TEST_F(TouchEvents, KeepTheNewestTransitionsWhenThereAreTooMany) {
  for (std::uint32_t id = 1; id <= 12; ++id) {
    frame({boxed(id, Phase::down)});  // the one before vanishes: down, up, down, up, ...
  }
  const TouchEvent* event = frame({boxed(12, Phase::move)});
  EXPECT_LE(event->transitions.size(), max_transitions);
  EXPECT_EQ(event->transitions.back().contact.id, 12U);
  BoxedContacts ten;
  for (std::uint32_t id = 20; id < 30; ++id)
    ten.push_back(boxed(id, Phase::down));
  frame(ten);
  for (BoxedContact& contact : ten)
    contact.phase = Phase::up;
  event = frame(ten);
  ASSERT_EQ(event->transitions.size(), max_transitions);
  EXPECT_EQ(event->transitions.back().contact.id, 29U);
  EXPECT_EQ(event->transitions.back().contact.phase, Phase::up);
}

TEST_F(TouchEvents, BeginAContactThatSlidIntoTheGridWithADown) {
  const TouchEvent* event = frame({boxed(1, Phase::move)});
  ASSERT_EQ(event->contacts.size(), 1U);
  EXPECT_EQ(event->contacts[0].phase, Phase::down);
  ASSERT_EQ(event->transitions.size(), 1U);
  EXPECT_EQ(event->transitions[0].contact.phase, Phase::down);
}

TEST_F(TouchEvents, EndAContactThatVanishedWithAnUpAtItsLastPlace) {
  frame({boxed(1, Phase::down, 7)});
  frame({boxed(1, Phase::move, 8)});
  const TouchEvent* event = frame({});
  ASSERT_NE(event, nullptr);
  EXPECT_TRUE(event->contacts.empty());
  ASSERT_EQ(event->transitions.size(), 2U);
  EXPECT_EQ(event->transitions[1].contact.phase, Phase::up);
  EXPECT_EQ(event->transitions[1].contact.box, 8);
}

TEST_F(TouchEvents, LeaveOutAnUpOfAContactThatWasNeverDown) {
  frame({boxed(1, Phase::down)});
  const TouchEvent* event = frame({boxed(1, Phase::move), boxed(2, Phase::up)});
  ASSERT_EQ(event->contacts.size(), 1U);
  EXPECT_EQ(event->transitions.size(), 1U);
}

TEST_F(TouchEvents, TakeARepeatedDownForAMove) {
  frame({boxed(1, Phase::down)});
  const TouchEvent* event = frame({boxed(1, Phase::down)});
  EXPECT_EQ(event->contacts[0].phase, Phase::move);
  EXPECT_EQ(event->transitions.size(), 1U);
}

TEST_F(TouchEvents, RepeatNoWithheldBeginButThoseThatGoOn) {
  frame({boxed(1, Phase::down), boxed(2, Phase::down)});
  builder.withhold_downs_except({boxed(2, Phase::move)});
  const TouchEvent* event = frame({boxed(2, Phase::move)});
  ASSERT_EQ(event->transitions.size(), 2U);
  EXPECT_EQ(event->transitions[0].contact.id, 2U);
  EXPECT_EQ(event->transitions[0].contact.phase, Phase::down);
  EXPECT_EQ(event->transitions[1].contact.id, 1U);
  EXPECT_EQ(event->transitions[1].contact.phase, Phase::up);
}

TEST_F(TouchEvents, AreBuiltWithoutAllocating) {
  BoxedContacts contacts{boxed(1, Phase::down), boxed(2, Phase::down)};
  const std::uint64_t before = allocation_count();
  for (int i = 0; i < 100; ++i) {
    for (BoxedContact& contact : contacts)
      contact.phase = i % 3 == 0 ? Phase::down : i % 3 == 1 ? Phase::move : Phase::up;
    frame(contacts);
  }
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace telehug
