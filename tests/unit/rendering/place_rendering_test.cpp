// SPDX-License-Identifier: Apache-2.0
//
// Rendering::places: what tap, hold, stroke, pat and hug feel like, where, and for how long.
#include <gmock/gmock.h>

#include <cmath>

#include "rendering/jacket_renderer.hpp"
#include "unit/rendering/rendering_builders.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr BodyPoint middle{0, 1};  // at motor 3 of the row

// The row of motors, three on the back behind its middle and ends, a heater in front and one behind.
JacketProfile vest(Uncovered uncovered = Uncovered::none) {
  std::vector<Actuator> actuators = row_of_motors();
  for (int i = 0; i < 3; ++i) {
    actuators.push_back(motor(static_cast<std::uint8_t>(6 + i), {i - 1.0, 1}, {}));
    actuators.back().side = BodySide::back;
  }
  actuators.push_back(heater(9, {0, 1.2}));
  actuators.push_back(heater(10, {0, 1.2}, BodySide::back));
  return places_of(std::move(actuators), uncovered);
}

class PlaceRendering : public ::testing::Test {
 protected:
  // For how long the motor runs from now on, if nothing more is heard.
  Duration runs_for(std::uint8_t id) {
    const Timestamp from = jacket.now;
    while (jacket.strength(id) > 0 && jacket.now - from < 1s)
      jacket.pass(ObedientJacket::round);
    return jacket.now - from;
  }

  ObedientJacket jacket{vest()};
};

TEST_F(PlaceRendering, feels_a_touch_at_its_place_as_strong_as_its_sender_says) {
  Contact touch = contact_at({-0.25, 1});
  touch.strength = 0.6;
  const JacketPlan& plan = jacket.feel(touch);
  EXPECT_THAT(plan.answers[0].actuators, ElementsAre(2, 3));
  EXPECT_EQ(plan.answers[0].outcome, FeltOutcome::driven);
  EXPECT_THAT(jacket.running(), ElementsAre(2, 3));
  EXPECT_NEAR(jacket.strength(2), 0.6 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(jacket.strength(3), 0.6 * std::sqrt(0.5), 1e-9);
}

TEST_F(PlaceRendering, says_that_a_place_is_uncovered_and_feels_nothing_there) {
  const JacketPlan& plan = jacket.feel(contact_at({0, 1.6}));
  EXPECT_EQ(plan.answers[0].outcome, FeltOutcome::uncovered);
  EXPECT_THAT(plan.answers[0].actuators, IsEmpty());
  EXPECT_THAT(jacket.running(), IsEmpty());
}

TEST_F(PlaceRendering, feels_an_uncovered_place_at_the_nearest_one_if_the_profile_says_so) {
  ObedientJacket nearest(vest(Uncovered::nearest));
  EXPECT_THAT(nearest.feel(contact_at({-1, 1.6})).answers[0].actuators, ElementsAre(1));
  EXPECT_THAT(nearest.running(), ElementsAre(1));
}

TEST_F(PlaceRendering, makes_a_tap_one_firm_pulse_however_short_it_is) {
  jacket.feel(contact_at(middle));
  jacket.pass(20ms);
  jacket.feel(contact_at(middle, Gesture::tap, Phase::up));
  EXPECT_EQ(jacket.strength(3), 1);
  EXPECT_EQ(runs_for(3), tap_pulse - 20ms);
}

TEST_F(PlaceRendering, feels_a_tap_as_strong_as_it_was_whatever_its_end_says) {
  Contact tap = contact_at(middle);
  tap.strength = 0.8;
  jacket.feel(tap);
  tap = contact_at(middle, Gesture::tap, Phase::up);
  tap.strength = 0;
  jacket.feel(tap);
  EXPECT_EQ(jacket.strength(3), 0.8);
}

TEST_F(PlaceRendering, ends_a_longer_tap_with_the_finger) {
  jacket.feel(contact_at(middle));
  jacket.rest(contact_at(middle), 270ms);
  EXPECT_GT(jacket.strength(3), 0.95) << "it is not known yet what it will be";
  jacket.feel(contact_at(middle, Gesture::tap, Phase::up));
  EXPECT_EQ(jacket.strength(3), 0);
}

TEST_F(PlaceRendering, pulses_a_tap_of_which_only_the_transitions_arrive) {
  const Contact tap = contact_at(middle);
  const Contact up = contact_at(middle, Gesture::tap, Phase::up);
  const JacketPlan& plan = jacket.feel(std::vector<Contact>{}, {transition_of(0, tap), transition_of(1, up)});
  ASSERT_EQ(plan.answers.size(), 2U);
  EXPECT_THAT(plan.answers[0].actuators, ElementsAre(3));
  EXPECT_EQ(runs_for(3), tap_pulse);
}

TEST_F(PlaceRendering, makes_a_pat_rounder_than_a_tap) {
  jacket.feel(contact_at(middle));
  jacket.pass(50ms);
  jacket.feel(contact_at(middle, Gesture::pat, Phase::up));
  jacket.pass(60ms);
  EXPECT_DOUBLE_EQ(jacket.strength(3), pat_level);
  EXPECT_EQ(runs_for(3), pat_pulse - 110ms);
}

TEST_F(PlaceRendering, ends_everything_when_no_event_comes_any_more) {
  jacket.feel(contact_at(middle, Gesture::hold));
  jacket.watch = [&] {
    for (const auto& [id, drive] : jacket.told)
      EXPECT_LE(drive.end, ObedientJacket::start + ObedientJacket::hold);
  };
  EXPECT_EQ(runs_for(3), ObedientJacket::hold);
  jacket.pass(3s);
  EXPECT_THAT(jacket.running(), IsEmpty());
}

TEST_F(PlaceRendering, takes_a_contact_that_was_not_heard_of_for_so_long_for_a_new_one) {
  const Contact hold = contact_at(middle, Gesture::hold, Phase::move);
  jacket.feel(hold);
  jacket.rest(hold, 3s);
  jacket.pass(250ms);
  jacket.feel(hold);
  EXPECT_EQ(jacket.strength(3), 1);
}

TEST_F(PlaceRendering, takes_it_for_a_new_one_also_if_nobody_went_on_meanwhile) {
  const Contact hold = contact_at(middle, Gesture::hold, Phase::move);
  jacket.feel(hold);
  jacket.rest(hold, 3s);
  jacket.now += 250ms;
  jacket.feel(hold);
  EXPECT_EQ(jacket.strength(3), 1);
}

TEST_F(PlaceRendering, lets_a_hold_fade_to_gentle_pulses) {
  const Contact hold = contact_at(middle, Gesture::hold);
  jacket.feel(hold);
  EXPECT_EQ(jacket.strength(3), 1);
  jacket.rest(hold, 1s);
  EXPECT_LT(jacket.strength(3), 0.8);
  jacket.rest(hold, 1s);
  int on = 0;
  int rounds = 0;
  jacket.watch = [&] {
    EXPECT_LE(jacket.strength(3), 0.4);
    on += jacket.strength(3) > 0 ? 1 : 0;
    ++rounds;
  };
  jacket.rest(hold, 30s);
  EXPECT_LT(on, rounds / 2);
  EXPECT_GT(on, rounds / 5);
}

TEST_F(PlaceRendering, keeps_a_stroke_gentle_and_changes_to_it_without_a_jerk) {
  jacket.feel(contact_at(middle));
  jacket.rest(contact_at(middle), 300ms);
  Contact stroke = contact_at(middle, Gesture::stroke, Phase::move);
  stroke.speed_mm_s = 50;
  double before = jacket.strength(3);
  jacket.watch = [&] {
    EXPECT_NEAR(jacket.strength(3), before, 0.11);
    before = jacket.strength(3);
  };
  jacket.rest(stroke, 300ms);
  EXPECT_NEAR(jacket.strength(3), stroke_level(50), 0.02);
}

TEST_F(PlaceRendering, lets_a_stroke_that_has_come_to_rest_fade_like_a_hold) {
  Contact stroke = contact_at(middle, Gesture::stroke, Phase::move);
  jacket.feel(stroke);
  jacket.rest(stroke, 2s);
  int off = 0;
  jacket.watch = [&] { off += jacket.strength(3) == 0 ? 1 : 0; };
  jacket.rest(stroke, 3s);
  EXPECT_GT(off, 150);
}

TEST_F(PlaceRendering, feels_the_strongest_of_several_contacts_and_never_their_sum) {
  Contact weak = contact_at({-0.5, 1});
  Contact strong = contact_at({-0.25, 1});
  strong.id = 2;
  weak.strength = 0.5;
  jacket.feel(std::vector{weak, strong});
  EXPECT_NEAR(jacket.strength(2), std::sqrt(0.5), 1e-9);
  weak.strength = 0.9;
  jacket.feel(std::vector{strong, weak});
  EXPECT_NEAR(jacket.strength(2), 0.9, 1e-9);
}

TEST_F(PlaceRendering, feels_two_hands_at_both_places_and_the_one_that_stays) {
  Contact left = contact_at({-1, 1}, Gesture::hold, Phase::move);
  Contact right = contact_at({1, 1}, Gesture::hold, Phase::move);
  right.id = 2;
  jacket.feel(std::vector{left, right});
  EXPECT_THAT(jacket.running(), ElementsAre(1, 5));
  jacket.pass(150ms);
  jacket.feel(left);
  EXPECT_THAT(jacket.running(), ElementsAre(1));
}

TEST_F(PlaceRendering, lets_a_hug_go_around_the_body_and_nothing_else) {
  for (const Gesture gesture : {Gesture::none, Gesture::tap, Gesture::hold, Gesture::stroke, Gesture::pat}) {
    ObedientJacket other(vest());
    other.feel(contact_at(middle, gesture));
    EXPECT_THAT(other.running(), ElementsAre(3));
  }
  EXPECT_THAT(jacket.feel(contact_at(middle, Gesture::hug)).answers[0].actuators, ElementsAre(3, 7));
  EXPECT_THAT(jacket.running(), ElementsAre(3, 7));
  EXPECT_EQ(jacket.strength(3), hug_level({}));
}

TEST_F(PlaceRendering, feels_touches_of_the_front_on_the_back_if_all_motors_are_there_and_the_profile_lets_them) {
  JacketProfile back = vest(Uncovered::nearest);
  for (Actuator& actuator : back.actuators)
    actuator.side = BodySide::back;
  ObedientJacket nearest(back);
  EXPECT_THAT(nearest.feel(contact_at(middle, Gesture::hug)).answers[0].actuators, ElementsAre(3, 7));
  EXPECT_THAT(nearest.running(), ElementsAre(3, 7)) << "both are at this place";
  back.uncovered = Uncovered::none;
  ObedientJacket none(back);
  EXPECT_EQ(none.feel(contact_at(middle)).answers[0].outcome, FeltOutcome::uncovered);
}

TEST_F(PlaceRendering, warms_where_a_hand_rests_for_long) {
  const Contact hold = contact_at(middle, Gesture::hold);
  jacket.feel(hold);
  jacket.rest(hold, 3s);
  EXPECT_EQ(jacket.strength(9), 0);
  jacket.rest(hold, 4s);
  EXPECT_NEAR(jacket.strength(9), 0.4, 0.05);
  jacket.rest(hold, 10s);
  EXPECT_EQ(jacket.strength(9), 1);
  EXPECT_EQ(jacket.strength(10), 0) << "it is on the back";
  jacket.feel(contact_at(middle, Gesture::hold, Phase::up));
  EXPECT_EQ(jacket.strength(9), 0);
}

TEST_F(PlaceRendering, warms_less_where_a_hand_is_farther_and_nothing_beyond) {
  const Contact near = contact_at({0.5, 1.2}, Gesture::hold);
  jacket.feel(near);
  jacket.rest(near, 14s);
  EXPECT_EQ(jacket.strength(9), 1);
  ObedientJacket other(vest());
  const Contact beside = contact_at({0.75, 1.2}, Gesture::hold);
  other.feel(beside);
  other.rest(beside, 14s);
  EXPECT_NEAR(other.strength(9), 0.5, 1e-9);
  const Contact far = contact_at({1, 1.2}, Gesture::hold);
  ObedientJacket another(vest());
  another.feel(far);
  another.rest(far, 14s);
  EXPECT_EQ(another.strength(9), 0);
}

TEST_F(PlaceRendering, warms_in_a_hug_the_back_as_well) {
  const Contact hug = contact_at(middle, Gesture::hug);
  jacket.feel(hug);
  jacket.rest(hug, 8s);
  EXPECT_NEAR(jacket.strength(9), 0.5, 0.05);
  EXPECT_NEAR(jacket.strength(10), 0.5, 0.05);
}

TEST_F(PlaceRendering, warms_by_nothing_else_than_holds_and_hugs) {
  for (const Gesture gesture : {Gesture::none, Gesture::tap, Gesture::stroke, Gesture::pat}) {
    ObedientJacket other(vest());
    other.watch = [&] { EXPECT_EQ(other.told.count(9) + other.told.count(10), 0U); };
    const Contact touch = contact_at(middle, gesture);
    other.feel(touch);
    other.rest(touch, 20s);
  }
}

TEST_F(PlaceRendering, warms_with_no_heater_that_is_off) {
  jacket.profile.actuators[8].enabled = false;
  const Contact hold = contact_at(middle, Gesture::hold);
  jacket.feel(hold);
  jacket.rest(hold, 10s);
  EXPECT_EQ(jacket.told.count(9), 0U);
}

TEST_F(PlaceRendering, kicks_a_motor_that_was_off_and_then_gives_what_is_wanted) {
  for (Actuator& actuator : jacket.profile.actuators)
    actuator.kick = 40ms;
  Contact touch = contact_at(middle);
  touch.strength = 0.4;
  jacket.feel(touch);
  EXPECT_EQ(jacket.strength(3), 1);
  jacket.pass(30ms);
  EXPECT_EQ(jacket.strength(3), 1);
  jacket.pass(10ms);
  EXPECT_NEAR(jacket.strength(3), 0.4, 1e-9);
}

TEST_F(PlaceRendering, leaves_the_wire_room_between_two_commands_that_only_change_a_little) {
  const Contact hold = contact_at(middle, Gesture::hold);
  jacket.feel(hold);
  jacket.rest(hold, 1s);
  const std::size_t before = jacket.commands;
  jacket.pass(190ms);
  EXPECT_LE(jacket.commands - before, 10U);
  EXPECT_GE(jacket.commands - before, 2U) << "it fades all the same";
}

TEST_F(PlaceRendering, forgets_all_touches_on_a_reset_and_when_the_clock_goes_back) {
  jacket.feel(contact_at(middle));
  jacket.renderer.reset();
  EXPECT_THAT(jacket.renderer.tick(jacket.now + 10ms), IsEmpty());
  jacket.feel(contact_at(middle, Gesture::none, Phase::move));
  EXPECT_THAT(jacket.renderer.tick(jacket.now - 1s), IsEmpty());
  EXPECT_THAT(jacket.renderer.tick(jacket.now - 990ms), IsEmpty());
}

TEST_F(PlaceRendering, tells_the_whole_state_with_every_event) {
  jacket.feel(contact_at({-0.25, 1}));
  jacket.pass(30ms);
  EXPECT_EQ(jacket.feel(contact_at({-0.25, 1}, Gesture::none, Phase::move)).drives.size(), 2U);
}

}  // namespace
}  // namespace telehug
