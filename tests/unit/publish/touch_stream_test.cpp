// SPDX-License-Identifier: Apache-2.0
#include "publish/touch_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "dds/validate.hpp"
#include "doubles/allocation_counter.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

constexpr GridShape seen_grid{.columns = 5, .rows = 2};
constexpr std::uint32_t seen_version = 7;

BoxedContact finger(std::uint32_t id, Phase phase = Phase::move) {
  return {.id = id, .phase = phase, .screen = {}, .speed_mm_s = 0, .grid = seen_grid, .box = 8, .body = {}};
}

class ATouchStream : public testing::Test {
 protected:
  const TouchEvent* send(const BoxedContacts& fingers, bool sending = true) {
    clock.advance(20ms);
    return checked(stream.build(fingers, seen_version, sending, clock.now() - 5ms, clock.now()));
  }
  const TouchEvent* send_without_camera() {
    clock.advance(20ms);
    return checked(stream.build(clock.now()));
  }
  // What the wire would refuse would be felt by nobody.
  const TouchEvent* checked(const TouchEvent* event) {
    if (event == nullptr) return nullptr;
    EXPECT_EQ(validate(*event), nullptr);
    EXPECT_GT(event->frame_time_ns, newest_frame_ns);
    newest_frame_ns = event->frame_time_ns;
    return event;
  }
  static std::ptrdiff_t downs(const TouchEvent& event) {
    return std::ranges::count(event.transitions, Phase::down, [](const Transition& t) { return t.contact.phase; });
  }

  FakeClock clock;
  TouchStream stream{example_session};
  std::int64_t newest_frame_ns = 0;
};

TEST_F(ATouchStream, HugsWithoutACameraAndFallsSilentAfterIt) {
  EXPECT_EQ(send_without_camera(), nullptr);
  stream.hug().begin({.duration = 1s}, clock.now());
  const TouchEvent* event = send_without_camera();
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->sequence, 1U);
  EXPECT_EQ(event->body_map_version, no_face_version);
  EXPECT_EQ(event->contacts.size(), HugPlayer::contacts_a_hug);
  EXPECT_EQ(downs(*event), 4);

  int events = 1;
  for (; event != nullptr && events < 1000; ++events)
    event = send_without_camera();
  EXPECT_NEAR(events, 50 + TouchEventBuilder::max_repeats, 3);
}

// A down that is lost would be taken for one that came late.
TEST_F(ATouchStream, RepeatsTheBeginOfAHugThoughFingersAreNotSent) {
  stream.hug().begin({}, clock.now());
  send_without_camera();
  EXPECT_EQ(downs(*send_without_camera()), 4);
}

TEST_F(ATouchStream, SendsFingersAndAHugInOneEventEachInItsOwnGrid) {
  send({finger(1, Phase::down)});
  stream.hug().begin({}, clock.now());
  const TouchEvent* event = send({finger(1)});
  ASSERT_EQ(event->contacts.size(), 5U);
  EXPECT_EQ(event->body_map_version, seen_version);
  const auto found = std::ranges::find(event->contacts, 1U, &Contact::id);
  ASSERT_NE(found, event->contacts.end());
  EXPECT_EQ(found->grid, seen_grid);
  EXPECT_EQ(found->phase, Phase::move);
}

TEST_F(ATouchStream, HugsThoughFingersAreNotSentAndEndsThose) {
  send({finger(1, Phase::down)});
  stream.hug().begin({}, clock.now());
  const TouchEvent* event = send({finger(1)}, false);
  ASSERT_EQ(event->contacts.size(), 4U);
  for (const Contact& contact : event->contacts)
    EXPECT_EQ(contact.gesture, Gesture::hug);
  for (const Transition& transition : event->transitions) {
    if (transition.contact.id == 1) {
      EXPECT_EQ(transition.contact.phase, Phase::up);
    }
  }
}

TEST_F(ATouchStream, EndsAHugThatIsBrokenOffAndTellsItsBeginNoMore) {
  stream.hug().begin({}, clock.now());
  send_without_camera();
  stream.hug().break_off();
  const TouchEvent* event = send_without_camera();
  ASSERT_NE(event, nullptr);
  EXPECT_TRUE(event->contacts.empty());
  EXPECT_EQ(downs(*event), 0);
  EXPECT_EQ(event->transitions.size(), 4U);
}

TEST_F(ATouchStream, LeavesOutFingersForWhichAHugLeavesNoRoom) {
  BoxedContacts hands;
  for (std::uint32_t id = 1; id <= max_contacts; ++id)
    hands.push_back(finger(id));
  send(hands);
  stream.hug().begin({}, clock.now());
  EXPECT_EQ(send(hands)->contacts.size(), max_contacts);
  stream.hug().break_off();
  EXPECT_EQ(send(hands)->contacts.size(), max_contacts);
}

TEST_F(ATouchStream, IsBuiltWithoutAllocating) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has a heap of its own";
  const BoxedContacts fingers{finger(1), finger(2)};
  const std::uint64_t before = allocation_count();
  for (int i = 0; i < 300; ++i) {
    clock.advance(20ms);
    if (i % 50 == 0) stream.hug().begin({.duration = 600ms}, clock.now());
    stream.build(fingers, seen_version, i % 40 < 20, clock.now(), clock.now());
  }
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace telehug
