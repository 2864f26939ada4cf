// SPDX-License-Identifier: Apache-2.0
#include "touch/gesture_recogniser.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "doubles/allocation_counter.hpp"
#include "touch/contact_tracker.hpp"

namespace telehug {
namespace {

constexpr Duration frame = std::chrono::microseconds{33'333};
// The middle fifth of it is x 230 to 270.
constexpr ScreenRect grid{150, 80, 200, 200};

class AGesture : public testing::Test {
 protected:
  struct Seen {
    std::uint32_t id;
    ScreenPoint at;
  };

  // One frame with these fingers on the screen; those of the frame before that are not among them are lifted.
  const ContactStates& see(const std::vector<Seen>& fingers) {
    now_ += frame;
    ContactStates contacts;
    for (const auto& [id, last] : down_) {
      const bool stays = std::ranges::find(fingers, id, &Seen::id) != fingers.end();
      if (!stays) contacts.push_back({.id = id, .phase = Phase::up, .screen = last, .frame_time = now_});
    }
    for (const Seen& finger : fingers) {
      const Phase phase = down_.contains(finger.id) ? Phase::move : Phase::down;
      contacts.push_back({.id = finger.id, .phase = phase, .screen = finger.at, .frame_time = now_});
    }
    down_.clear();
    for (const Seen& finger : fingers)
      down_[finger.id] = finger.at;
    last_ = recogniser_.update(contacts, grid_);
    return last_;
  }
  Gesture of(std::uint32_t id) const {
    const auto found = std::ranges::find(last_, id, &ContactState::id);
    return found == last_.end() ? Gesture::none : found->gesture;
  }
  Gesture rest(const std::vector<Seen>& fingers, Duration time) {
    for (const Timestamp end = now_ + time; now_ < end;)
      see(fingers);
    return fingers.empty() ? Gesture::none : of(fingers.front().id);
  }
  Gesture tap(std::uint32_t id, ScreenPoint at) {
    rest({{id, at}}, 100ms);
    see({});
    return of(id);
  }

  std::optional<ScreenRect> grid_ = grid;
  GestureRecogniser recogniser_;
  Timestamp now_{1s};
  std::map<std::uint32_t, ScreenPoint> down_;
  ContactStates last_;
};

TEST_F(AGesture, IsATapWhenTheFingerIsLiftedSoonAtItsPlace) {
  EXPECT_EQ(rest({{1, {200, 150}}}, 300ms), Gesture::none) << "it may still become anything";
  see({});
  EXPECT_EQ(of(1), Gesture::tap);
}

TEST_F(AGesture, IsAHoldWhileTheFingerRestsAndWhenItIsLifted) {
  EXPECT_EQ(rest({{1, {200, 150}}}, 390ms), Gesture::none);
  EXPECT_EQ(rest({{1, {204, 153}}}, 100ms), Gesture::hold);
  see({});
  EXPECT_EQ(of(1), Gesture::hold);
}

// The tracker holds a finger that is not seen at its last place and time.
TEST_F(AGesture, IsNoHoldByAFingerThatIsOnlyRemembered) {
  rest({{1, {200, 150}}}, 370ms);
  ContactStates held{{.id = 1, .phase = Phase::move, .screen = {200, 150}, .frame_time = now_}};
  EXPECT_EQ(recogniser_.update(held, grid_)[0].gesture, Gesture::none);
  held[0].phase = Phase::up;
  held[0].frame_time = now_ + 100ms;
  EXPECT_EQ(recogniser_.update(held, grid_)[0].gesture, Gesture::tap);
}

TEST_F(AGesture, IsAStrokeFromTenMillimetresOnHoweverLongItTakes) {
  see({{1, {200, 150}}});
  see({{1, {200, 159.9}}});
  EXPECT_EQ(of(1), Gesture::none);
  see({{1, {200, 160}}});
  EXPECT_EQ(of(1), Gesture::stroke);
  EXPECT_EQ(rest({{1, {200, 150}}}, 1s), Gesture::stroke) << "it rests where it began";
  see({});
  EXPECT_EQ(of(1), Gesture::stroke);
}

TEST_F(AGesture, IsAStrokeAfterAHold) {
  EXPECT_EQ(rest({{1, {200, 150}}}, 500ms), Gesture::hold);
  see({{1, {215, 150}}});
  EXPECT_EQ(of(1), Gesture::stroke);
}

TEST_F(AGesture, IsAPatWhenATapFollowsAnother) {
  EXPECT_EQ(tap(1, {200, 150}), Gesture::tap);
  rest({}, 200ms);
  EXPECT_EQ(tap(2, {220, 170}), Gesture::pat);
  rest({}, 200ms);
  EXPECT_EQ(tap(3, {200, 150}), Gesture::pat);
}

TEST_F(AGesture, IsNoPatFarAwayOrLater) {
  EXPECT_EQ(tap(1, {160, 150}), Gesture::tap);
  rest({}, 200ms);
  EXPECT_EQ(tap(2, {245, 150}), Gesture::tap);
  rest({}, 600ms);
  EXPECT_EQ(tap(3, {245, 150}), Gesture::tap);
}

TEST_F(AGesture, IsNoPatOfTwoFingersThatTapTogether) {
  rest({{1, {200, 150}}, {2, {215, 150}}}, 100ms);
  see({});
  EXPECT_EQ(of(1), Gesture::tap);
  EXPECT_EQ(of(2), Gesture::tap);
}

TEST_F(AGesture, IsAHugWhenBothSidesOfTheBodyAreHeldAtOnce) {
  const Seen left{1, {180, 200}};
  const Seen right{2, {320, 210}};
  const Seen second_right{3, {330, 240}};
  EXPECT_EQ(rest({left}, 500ms), Gesture::hold);
  rest({left, right, second_right}, 300ms);
  EXPECT_EQ(of(1), Gesture::hold);
  rest({left, right, second_right}, 200ms);
  EXPECT_EQ(of(1), Gesture::hug);
  EXPECT_EQ(of(2), Gesture::hug);
  EXPECT_EQ(of(3), Gesture::hug);
  see({{1, {195, 200}}});
  EXPECT_EQ(of(2), Gesture::hug) << "the first hand that lets go";
  EXPECT_EQ(of(1), Gesture::hug) << "the other one, though it moves";
  see({});
  EXPECT_EQ(of(1), Gesture::hug);
}

TEST_F(AGesture, IsNoHugOnOneSideInTheMiddleBesideTheBodyOrWithoutAPerson) {
  EXPECT_EQ(rest({{1, {180, 200}}, {2, {200, 210}}}, 1s), Gesture::hold);
  EXPECT_EQ(rest({{3, {180, 200}}, {4, {260, 210}}}, 1s), Gesture::hold);
  EXPECT_EQ(rest({{5, {180, 200}}, {6, {355, 210}}}, 1s), Gesture::hold);
  EXPECT_EQ(rest({{7, {180, 200}}, {8, {320, 70}}}, 1s), Gesture::hold);
  grid_.reset();
  EXPECT_EQ(rest({{9, {180, 200}}, {10, {320, 210}}}, 1s), Gesture::hold);
}

TEST_F(AGesture, IsNoHugWhenAHandStrokes) {
  rest({{1, {180, 200}}, {2, {320, 210}}}, 200ms);
  see({{1, {180, 200}}, {2, {320, 230}}});
  rest({{1, {180, 200}}, {2, {320, 230}}}, 1s);
  EXPECT_EQ(of(1), Gesture::hold);
  EXPECT_EQ(of(2), Gesture::stroke);
}

TEST_F(AGesture, BelongsToItsContactAlone) {
  rest({{1, {200, 150}}}, 500ms);
  see({{2, {203, 150}}});
  EXPECT_EQ(of(1), Gesture::hold);
  EXPECT_EQ(of(2), Gesture::none);
}

// Which may come after which.
bool may_follow(Gesture before, Gesture after) {
  if (before == after || before == Gesture::none) return true;
  return before == Gesture::hold && (after == Gesture::stroke || after == Gesture::hug);
}

// Whatever fingers and times do: one final gesture a contact, never none, and no other before it than a hold.
TEST(Gestures, AreFinalOncePerContactForAnyFingersAndTimes) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> place(100, 400);
  std::uniform_int_distribution<int> percent(0, 99);
  std::normal_distribution<double> step_mm(0, 3);
  ContactTracker tracker;
  GestureRecogniser recogniser;
  std::map<std::uint32_t, Gesture> alive;
  std::map<Gesture, int> finals;
  ScreenPoints points;
  Timestamp now{1h};
  for (int i = 0; i < 60000; ++i) {
    const int dice = percent(random);
    if (dice < 6 && points.size() < points.capacity()) points.push_back({place(random), place(random)});
    if (dice >= 90 && !points.empty()) points.erase(points.begin());
    for (ScreenPoint& point : points) {
      if (percent(random) < 10) point.x_mm += step_mm(random);
    }
    now += frame;
    if (i % 500 == 0) now += 3h;
    if (i % 700 == 0) now -= 2h;  // never while the program runs, but if
    const bool face = i / 1000 % 4 != 0;
    const ContactStates& states =
        recogniser.update(tracker.update(without_evidence(points), now), face ? std::optional(grid) : std::nullopt);
    for (const ContactState& state : states) {
      if (state.phase == Phase::down) {
        ASSERT_TRUE(alive.emplace(state.id, Gesture::none).second);
      }
      const auto known = alive.find(state.id);
      ASSERT_NE(known, alive.end()) << "a gesture after the final one";
      if (state.phase == Phase::up) {
        ASSERT_NE(state.gesture, Gesture::none);
        ASSERT_TRUE(may_follow(known->second, state.gesture));
        ++finals[state.gesture];
        alive.erase(known);
        continue;
      }
      ASSERT_NE(state.gesture, Gesture::tap);
      ASSERT_NE(state.gesture, Gesture::pat);
      ASSERT_TRUE(may_follow(known->second, state.gesture));
      known->second = state.gesture;
    }
  }
  for (const Gesture gesture : {Gesture::tap, Gesture::hold, Gesture::stroke, Gesture::pat, Gesture::hug})
    EXPECT_GT(finals[gesture], 10) << static_cast<int>(gesture);
}

// No source makes such contacts; nothing may break by them.
TEST(Gestures, SurviveContactsThatBreakEveryRule) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> any(0, 14);
  std::uniform_int_distribution<std::int64_t> time(0, 1'000'000'000'000);
  GestureRecogniser recogniser;
  for (int i = 0; i < 20000; ++i) {
    ContactStates contacts;
    for (int n = any(random); n > 0 && contacts.size() < contacts.capacity(); --n) {
      contacts.push_back({.id = static_cast<std::uint32_t>(any(random)),
                          .phase = static_cast<Phase>(any(random) % 3),
                          .screen = {30.0 * any(random), 30.0 * any(random)},
                          .frame_time = from_ns(time(random))});
    }
    ASSERT_EQ(recogniser.update(contacts, grid).size(), contacts.size());
  }
}

TEST(Gestures, AllocateNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has its own heap";
  ContactTracker tracker;
  GestureRecogniser recogniser;
  const auto before = allocation_count();
  for (int i = 0; i < 200; ++i) {
    ScreenPoints points;
    for (int p = 0; p < i / 7 % 11; ++p)
      points.push_back({37.0 * p, 100});
    recogniser.update(tracker.update(without_evidence(points), Timestamp{1s} + i * frame), grid);
  }
  EXPECT_EQ(allocation_count() - before, 0U);
}

}  // namespace
}  // namespace telehug
