// SPDX-License-Identifier: Apache-2.0
//
// Rendering::boxes: the motors that serve the touched box, all alike, for as long as it is touched.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "rendering/box_table.hpp"
#include "rendering/jacket_renderer.hpp"
#include "unit/rendering/rendering_builders.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Timestamp start = from_ns(5'000'000'000);
constexpr Duration hold = 200ms;

MATCHER_P3(IsDrive, actuator, strength, end, "") {
  return arg.actuator == actuator && arg.strength == strength && arg.end == end;
}

// Two motors on the chest, one of them also for the middle; one on the belly.
JacketProfile chest_and_belly(Uncovered uncovered = Uncovered::none) {
  return profile_of({motor(1, {-0.5, 0.75}, {7, 8}), motor(2, {0.5, 0.75}, {9}), motor(3, {0, 1.75}, {18})}, uncovered);
}

std::vector<int> ids_of(const Spot& spot, const JacketProfile& profile) {
  std::vector<int> ids;
  for (const SpotShare& share : spot)
    ids.push_back(profile.actuators[share.index].id);
  return ids;
}

std::vector<int> motors_at(const Contact& contact, const JacketProfile& profile) {
  return ids_of(motors_of_box(contact, profile), profile);
}

class BoxRendering : public ::testing::Test {
 protected:
  const JacketPlan& plan(const TouchEvent& event, const std::vector<Transition>& fresh = {}, Timestamp now = start) {
    return renderer.plan(event, fresh, now);
  }

  JacketProfile profile = chest_and_belly();
  JacketRenderer renderer{profile, hold};
};

TEST_F(BoxRendering, drives_the_actuators_that_serve_the_box_until_the_drive_duration_is_over) {
  const JacketPlan& made = plan(event_of(1, {contact_in(7)}));
  EXPECT_THAT(made.drives, ElementsAre(IsDrive(1, 1.0, start + hold)));
}

TEST_F(BoxRendering, drives_every_actuator_of_a_box_that_several_serve) {
  EXPECT_THAT(motors_at(contact_in(3), profile_of({motor(1, {-0.3, 0.4}, {3}), motor(2, {0.3, 0.4}, {3})})),
              ElementsAre(1, 2));
}

TEST_F(BoxRendering, answers_each_contact_with_its_place_and_actuators) {
  const JacketPlan& made = plan(event_of(4, {contact_in(7, 11), contact_in(1, 12, Phase::move)}));
  ASSERT_EQ(made.answers.size(), 2U);
  EXPECT_EQ(made.answers[0].touch_sequence, 4U);
  EXPECT_EQ(made.answers[0].contact_id, 11U);
  EXPECT_EQ(made.answers[0].phase, Phase::down);
  EXPECT_EQ(made.answers[0].box, 7);
  EXPECT_EQ(made.answers[0].outcome, FeltOutcome::driven);
  EXPECT_THAT(made.answers[0].actuators, ElementsAre(1));
  EXPECT_EQ(made.answers[1].outcome, FeltOutcome::uncovered);
  EXPECT_THAT(made.answers[1].actuators, IsEmpty());
}

TEST_F(BoxRendering, gives_an_uncovered_box_to_the_nearest_actuator_only_if_the_profile_says_so) {
  EXPECT_THAT(motors_at(contact_in(20), chest_and_belly(Uncovered::nearest)), ElementsAre(3));
  EXPECT_THAT(motors_at(contact_in(6), chest_and_belly(Uncovered::nearest)), ElementsAre(1));
  EXPECT_THAT(motors_at(contact_in(6), chest_and_belly(Uncovered::none)), IsEmpty());
}

TEST_F(BoxRendering, reads_a_grid_of_another_shape_through_the_place_on_the_body) {
  Contact touch = contact_in(9);
  touch.grid = {10, 8};
  touch.box = 34;
  EXPECT_THAT(motors_at(touch, chest_and_belly()), ElementsAre(2));
  touch.body = {9, 9};
  EXPECT_THAT(motors_at(touch, chest_and_belly()), IsEmpty());
  EXPECT_THAT(motors_at(touch, chest_and_belly(Uncovered::nearest)), ElementsAre(3));
}

TEST_F(BoxRendering, feels_nothing_where_box_and_place_are_nonsense) {
  Contact touch = contact_in(7);
  touch.box = 21;  // of 20
  touch.body = {std::nan(""), 0.75};
  EXPECT_THAT(motors_at(touch, chest_and_belly(Uncovered::nearest)), IsEmpty());
  touch.body = {std::numeric_limits<double>::infinity(), 0.75};
  EXPECT_THAT(motors_at(touch, chest_and_belly(Uncovered::nearest)), IsEmpty());
  touch.body = {1e300, -1e300};
  EXPECT_THAT(motors_at(touch, chest_and_belly(Uncovered::none)), IsEmpty());
}

TEST_F(BoxRendering, ends_the_drive_when_the_finger_goes_up) {
  plan(event_of(1, {contact_in(7)}));
  const JacketPlan& up = plan(event_of(2, {contact_in(7, 1, Phase::up)}));
  EXPECT_THAT(up.drives, ElementsAre(IsDrive(1, 0.0, start)));
}

TEST_F(BoxRendering, ends_the_drive_when_the_contact_is_gone_though_its_up_was_lost) {
  plan(event_of(1, {contact_in(7)}));
  EXPECT_THAT(plan(event_of(2, {})).drives, ElementsAre(IsDrive(1, 0.0, start)));
}

TEST_F(BoxRendering, ends_the_old_place_when_the_finger_moves_on) {
  plan(event_of(1, {contact_in(7)}));
  const JacketPlan& moved = plan(event_of(2, {contact_in(9, 1, Phase::move)}));
  EXPECT_THAT(moved.drives, ElementsAre(IsDrive(1, 0.0, start), IsDrive(2, 1.0, start + hold)));
}

TEST_F(BoxRendering, keeps_an_actuator_that_another_finger_still_holds) {
  plan(event_of(1, {contact_in(7, 1), contact_in(8, 2)}));
  const JacketPlan& one = plan(event_of(2, {contact_in(7, 1, Phase::up), contact_in(8, 2, Phase::move)}));
  EXPECT_THAT(one.drives, ElementsAre(IsDrive(1, 1.0, start + hold)));
}

TEST_F(BoxRendering, says_only_once_that_a_drive_has_ended) {
  plan(event_of(1, {contact_in(7)}));
  plan(event_of(2, {}));
  EXPECT_THAT(plan(event_of(3, {})).drives, IsEmpty());
}

TEST_F(BoxRendering, gives_the_strongest_of_several_contacts_and_never_their_sum) {
  Contact weak = contact_in(7, 1);
  Contact strong = contact_in(8, 2);
  weak.strength = 0.5;
  strong.strength = 0.7;
  EXPECT_THAT(plan(event_of(1, {weak, strong})).drives, ElementsAre(IsDrive(1, 0.7, start + hold)));
  EXPECT_THAT(plan(event_of(1, {strong, weak})).drives, ElementsAre(IsDrive(1, 0.7, start + hold)));
}

TEST_F(BoxRendering, takes_a_strength_that_is_no_number_for_none) {
  Contact broken = contact_in(7);
  broken.strength = std::nan("");
  EXPECT_THAT(plan(event_of(1, {broken})).drives, IsEmpty());
}

TEST_F(BoxRendering, pulses_a_tap_of_which_only_the_transitions_arrive) {
  const auto tap = {transition_of(1, contact_in(7)), transition_of(2, contact_in(7, 1, Phase::up))};
  const JacketPlan& made = plan(event_of(3, {}), tap);
  EXPECT_THAT(made.drives, ElementsAre(IsDrive(1, 1.0, start + hold)));
  ASSERT_EQ(made.answers.size(), 2U);
  EXPECT_EQ(made.answers[0].touch_sequence, 1U);
  EXPECT_EQ(made.answers[0].phase, Phase::down);
  EXPECT_THAT(made.answers[0].actuators, ElementsAre(1));
  EXPECT_EQ(made.answers[1].touch_sequence, 2U);
  EXPECT_EQ(made.answers[1].phase, Phase::up);
}

TEST_F(BoxRendering, pulses_a_tap_whose_up_arrives_in_time_but_whose_down_was_lost) {
  const JacketPlan& made = plan(event_of(2, {contact_in(7, 1, Phase::up)}), {transition_of(1, contact_in(7))});
  EXPECT_THAT(made.drives, ElementsAre(IsDrive(1, 1.0, start + hold)));
}

TEST_F(BoxRendering, lets_a_late_tap_run_through_the_events_that_follow) {
  plan(event_of(3, {}), {transition_of(1, contact_in(7))});
  EXPECT_THAT(plan(event_of(4, {}), {}, start + 33ms).drives, ElementsAre(IsDrive(1, 1.0, start + hold)));
  EXPECT_THAT(plan(event_of(5, {contact_in(9, 2)}), {}, start + 66ms).drives,
              ElementsAre(IsDrive(1, 1.0, start + hold), IsDrive(2, 1.0, start + 66ms + hold)));
  EXPECT_THAT(plan(event_of(12, {}), {}, start + hold).drives, ElementsAre(IsDrive(2, 0.0, start + hold)));
}

TEST_F(BoxRendering, does_not_pulse_for_a_late_down_of_a_finger_that_is_still_there) {
  const JacketPlan& made = plan(event_of(2, {contact_in(9, 1, Phase::move)}), {transition_of(1, contact_in(7))});
  EXPECT_THAT(made.drives, ElementsAre(IsDrive(2, 1.0, start + hold)));
  ASSERT_EQ(made.answers.size(), 2U);
  EXPECT_EQ(made.answers[1].touch_sequence, 1U);
}

TEST_F(BoxRendering, answers_a_contact_once_though_the_event_repeats_it_as_a_transition) {
  EXPECT_EQ(plan(event_of(1, {contact_in(7)}), {transition_of(1, contact_in(7))}).answers.size(), 1U);
}

TEST_F(BoxRendering, does_not_feel_a_tap_that_comes_much_too_late) {
  const JacketPlan& made = plan(event_of(50, {}), {transition_of(1, contact_in(7))});
  EXPECT_THAT(made.drives, IsEmpty());
  ASSERT_EQ(made.answers.size(), 1U);
  EXPECT_EQ(made.answers[0].outcome, FeltOutcome::stale);
  EXPECT_THAT(made.answers[0].actuators, IsEmpty());
}

TEST_F(BoxRendering, forgets_a_pulse_when_the_clock_jumps_back) {
  plan(event_of(3, {}), {transition_of(1, contact_in(7))});
  EXPECT_THAT(plan(event_of(4, {}), {}, start - 1s).drives, IsEmpty());
  EXPECT_THAT(renderer.tick(start - 990ms), IsEmpty());
}

TEST_F(BoxRendering, does_not_change_with_time_or_gesture) {
  Contact held = contact_in(7, 1, Phase::move);
  for (const Gesture gesture : {Gesture::none, Gesture::hold, Gesture::stroke, Gesture::hug}) {
    held.gesture = gesture;
    const Timestamp now = start + 10s * static_cast<int>(gesture);
    EXPECT_THAT(plan(event_of(1, {held}), {}, now).drives, ElementsAre(IsDrive(1, 1.0, now + hold)));
    EXPECT_THAT(renderer.tick(now + 100ms), IsEmpty());
  }
}

TEST_F(BoxRendering, never_drives_what_is_switched_off_or_is_no_motor) {
  JacketProfile partly_off = chest_and_belly(Uncovered::nearest);
  partly_off.actuators[0].enabled = false;
  partly_off.actuators.push_back(heater(4, {-0.5, 0.75}));
  partly_off.actuators.back().boxes = {7};
  EXPECT_THAT(motors_at(contact_in(7), partly_off), ElementsAre(2));
  partly_off.uncovered = Uncovered::none;
  EXPECT_THAT(motors_at(contact_in(7), partly_off), IsEmpty());
}

}  // namespace
}  // namespace telehug
