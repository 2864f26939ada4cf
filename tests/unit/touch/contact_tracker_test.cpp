// SPDX-License-Identifier: Apache-2.0
#include "touch/contact_tracker.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "doubles/allocation_counter.hpp"

namespace telehug {
namespace {

constexpr Duration frame = std::chrono::microseconds{33'333};

FingerObservations touches(const ScreenPoints& points) {
  return without_evidence(points);
}

Timestamp at(int number) {
  return Timestamp{1s} + number * frame;
}

TEST(ContactTracker, ReportsDownThenMoveThenUpOnce) {
  ContactTracker tracker({.every_finger_touches = true, .up_after_missed_frames = 2, .up_after = 1s});
  EXPECT_TRUE(tracker.update(touches({}), at(0)).empty());

  ContactStates states = tracker.update(touches({{100, 100}}), at(1));
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states[0].phase, Phase::down);
  EXPECT_EQ(states[0].frame_time, at(1));
  const auto id = states[0].id;
  EXPECT_NE(id, 0U);

  states = tracker.update(touches({{103, 104}}), at(2));
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states[0].phase, Phase::move);
  EXPECT_EQ(states[0].id, id);
  EXPECT_NEAR(states[0].speed_mm_s, 150, 0.01);  // 5 mm in a frame

  states = tracker.update(touches({}), at(3));  // held
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states[0].phase, Phase::move);
  EXPECT_EQ(states[0].screen.x_mm, 103);
  EXPECT_EQ(states[0].frame_time, at(2));
  EXPECT_EQ(states[0].speed_mm_s, 0);

  states = tracker.update(touches({}), at(4));
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states[0].phase, Phase::up);
  EXPECT_EQ(states[0].id, id);
  EXPECT_EQ(states[0].screen.y_mm, 104);
  EXPECT_EQ(states[0].frame_time, at(4));

  EXPECT_TRUE(tracker.update(touches({}), at(5)).empty());
  EXPECT_NE(tracker.update(touches({{103, 104}}), at(6))[0].id, id);
}

TEST(ContactTracker, EndsAContactWhenNoFrameComesInTime) {
  ContactTracker tracker({.every_finger_touches = true, .up_after_missed_frames = 100, .up_after = 70ms});
  tracker.update(touches({{10, 10}}), at(0));
  EXPECT_EQ(tracker.update(touches({}), at(0) + 69ms)[0].phase, Phase::move);
  EXPECT_EQ(tracker.update(touches({}), at(0) + 70ms)[0].phase, Phase::up);
}

TEST(ContactTracker, TakesUpAContactThatWasHeld) {
  ContactTracker tracker({.every_finger_touches = true, .up_after_missed_frames = 3, .up_after = 1s});
  const auto id = tracker.update(touches({{10, 10}}), at(0))[0].id;
  tracker.update(touches({}), at(1));
  const ContactStates states = tracker.update(touches({{16, 18}}), at(2));
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states[0].id, id);
  EXPECT_NEAR(states[0].speed_mm_s, 150, 0.01);  // 10 mm in two frames
}

TEST(ContactTracker, TakesAPointBeyondTheGateForAnotherFinger) {
  ContactTracker tracker({.every_finger_touches = true, .gate_mm = 40});
  const auto id = tracker.update(touches({{100, 100}}), at(0))[0].id;
  EXPECT_EQ(tracker.update(touches({{140, 100}}), at(1))[0].id, id);
  const ContactStates states = tracker.update(touches({{181, 100}}), at(2));
  ASSERT_EQ(states.size(), 2U);
  EXPECT_EQ(states[0].id, id);
  EXPECT_EQ(states[0].screen.x_mm, 140);
  EXPECT_EQ(states[1].phase, Phase::down);
}

TEST(ContactTracker, KeepsIdentitiesOfFingersThatMoveTogether) {
  ContactTracker tracker({.every_finger_touches = true});
  ScreenPoints points{{100, 100}, {115, 100}, {130, 100}};
  std::map<std::uint32_t, double> y_of;
  for (const ContactState& state : tracker.update(touches(points), at(0)))
    y_of[state.id] = state.screen.x_mm;
  for (int i = 1; i < 30; ++i) {
    ScreenPoints moved;
    for (const ScreenPoint& point : points)
      moved.push_back({point.x_mm, point.y_mm + 5.0 * i});
    std::reverse(moved.begin(), moved.end());  // the order of the points means nothing
    const ContactStates& states = tracker.update(touches(moved), at(i));
    ASSERT_EQ(states.size(), 3U);
    for (const ContactState& state : states)
      ASSERT_EQ(y_of.at(state.id), state.screen.x_mm);
  }
}

TEST(ContactTracker, BeginsNothingNewWhileTheSceneIsDisturbedButGoesOn) {
  ContactTracker tracker({.every_finger_touches = true});
  EXPECT_TRUE(tracker.update(touches({{10, 10}}), at(0), Scene::disturbed).empty());
  const auto id = tracker.update(touches({{10, 10}}), at(1))[0].id;
  const ContactStates& states = tracker.update(touches({{12, 10}, {200, 10}}), at(2), Scene::disturbed);
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states[0].id, id);
  EXPECT_EQ(states[0].screen.x_mm, 12);
}

TEST(ContactTracker, WaitsForTheNextPictureOfASlowCameraAndEndsContactsWhenNoneComes) {
  ContactTracker tracker({.every_finger_touches = true, .up_after = 70ms});
  const auto id = tracker.update(touches({{10, 10}}), Timestamp{})[0].id;
  EXPECT_EQ(tracker.pass(Timestamp{50ms}).at(0).phase, Phase::move);
  EXPECT_EQ(tracker.pass(Timestamp{99ms}).at(0).phase, Phase::move);
  EXPECT_EQ(tracker.update(touches({{12, 10}}), Timestamp{100ms}).at(0).id, id);
  EXPECT_EQ(tracker.pass(Timestamp{200ms}).at(0).phase, Phase::move);
  EXPECT_EQ(tracker.pass(Timestamp{250ms}).at(0).phase, Phase::up);
  EXPECT_TRUE(tracker.pass(Timestamp{260ms}).empty());
  EXPECT_NE(tracker.update(touches({{12, 10}}), Timestamp{300ms}).at(0).id, id);
}

TEST(ContactTracker, SurvivesTimesThatDoNotRise) {
  ContactTracker tracker({.every_finger_touches = true});
  tracker.update(touches({{10, 10}}), at(5));
  const ContactStates states = tracker.update(touches({{11, 10}}), at(5));
  EXPECT_EQ(states[0].speed_mm_s, 0);
  EXPECT_EQ(tracker.update(touches({{12, 10}}), at(4))[0].phase, Phase::move);
}

TEST(ContactTracker, HoldsAtMostTenAndTakesNewOnesWhenPlacesAreFree) {
  ContactTracker tracker({.every_finger_touches = true, .gate_mm = 10, .up_after_missed_frames = 1});
  ScreenPoints ten;
  for (int i = 0; i < 10; ++i)
    ten.push_back({40.0 * i, 100});
  EXPECT_EQ(tracker.update(touches(ten), at(0)).size(), 10U);
  for (ScreenPoint& point : ten)
    point.y_mm = 200;
  ContactStates states = tracker.update(touches(ten), at(1));  // the first ten end
  ASSERT_EQ(states.size(), 10U);
  for (const ContactState& state : states)
    EXPECT_EQ(state.phase, Phase::up);
  states = tracker.update(touches(ten), at(2));
  ASSERT_EQ(states.size(), 10U);
  for (const ContactState& state : states)
    EXPECT_EQ(state.phase, Phase::down);
}

// What has to hold whatever the points do.
TEST(ContactTracker, KeepsItsPromisesForRandomPoints) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0, 200);
  std::uniform_int_distribution<int> number(0, 10);
  ContactTracker tracker({.every_finger_touches = true, .up_after_missed_frames = 2});
  std::set<std::uint32_t> alive;
  std::set<std::uint32_t> ended;
  for (int i = 0; i < 5000; ++i) {
    ScreenPoints points;
    for (int n = number(random); n > 0; --n)
      points.push_back({place(random), place(random)});
    const ContactStates& states = tracker.update(touches(points), at(i));
    std::set<std::uint32_t> seen;
    for (const ContactState& state : states) {
      ASSERT_TRUE(seen.insert(state.id).second) << "an id twice in a frame";
      ASSERT_FALSE(ended.contains(state.id)) << "an id after its up";
      ASSERT_EQ(alive.contains(state.id), state.phase != Phase::down);
      if (state.phase == Phase::up) {
        alive.erase(state.id);
        ended.insert(state.id);
      } else {
        alive.insert(state.id);
      }
    }
    for (const auto id : alive)
      ASSERT_TRUE(seen.contains(id)) << "a contact that lives was not reported";
  }
  EXPECT_GT(ended.size(), 100U);
}

TEST(ContactTracker, AllocatesNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has its own heap";
  ContactTracker tracker({.every_finger_touches = true});
  const auto before = allocation_count();
  for (int i = 0; i < 100; ++i) {
    ScreenPoints points;
    for (int p = 0; p < i % 11; ++p)
      points.push_back({37.0 * p, 5.0 * i});
    tracker.update(touches(points), at(i));
  }
  EXPECT_EQ(allocation_count() - before, 0U);
}

}  // namespace
}  // namespace telehug
