// SPDX-License-Identifier: Apache-2.0
//
// Touches in, exact drives out: what the safety stage is told, and when (ms: actuator=strength-end in ms).
#include <gtest/gtest.h>

#include "unit/rendering/rendering_builders.hpp"

namespace telehug {
namespace {

JacketProfile row_with_kicks() {
  JacketProfile profile = places_of(row_of_motors());
  for (Actuator& actuator : profile.actuators) {
    actuator.kick = 30ms;
    actuator.gamma = 2;
  }
  return profile;
}

TEST(RenderingGolden, tap_between_two_motors) {
  ObedientJacket jacket(row_with_kicks());
  jacket.feel(contact_at({0.125, 1}));
  jacket.pass(30ms);
  jacket.feel(contact_at({0.125, 1}, Gesture::tap, Phase::up));
  jacket.pass(30ms);
  jacket.feel(std::vector<Contact>{});
  jacket.pass(300ms);
  EXPECT_EQ(jacket.log,
            "0: 3=1.00-50 4=1.00-50\n"
            "30: 3=0.75-200 4=0.25-200\n"
            "30: 3=0.75-100 4=0.25-100\n"
            "60: 3=0.75-100 4=0.25-100\n");
}

TEST(RenderingGolden, hold_that_fades) {
  ObedientJacket jacket(places_of(row_of_motors()));
  jacket.feel(contact_at({0, 1}));
  jacket.rest(contact_at({0, 1}, Gesture::hold), 600ms, 60ms);
  jacket.feel(contact_at({0, 1}, Gesture::hold, Phase::up));
  EXPECT_EQ(jacket.log,
            "0: 3=1.00-200\n"
            "60: 3=1.00-260\n"
            "120: 3=1.00-320\n"
            "180: 3=1.00-380\n"
            "240: 3=1.00-440\n"
            "300: 3=0.99-500\n"
            "360: 3=0.98-560\n"
            "420: 3=0.97-620\n"
            "480: 3=0.95-620\n"
            "480: 3=0.95-680\n"
            "540: 3=0.93-680\n"
            "540: 3=0.93-740\n"
            "590: 3=0.91-740\n"
            "600: 3=0.91-800\n"
            "600: 3=0.00\n");
}

TEST(RenderingGolden, fast_stroke_past_three_motors) {
  ObedientJacket jacket(places_of(row_of_motors()));
  jacket.feel(contact_at({-0.6, 1}));
  for (int n = 1; n <= 6; ++n) {
    jacket.pass(30ms);
    Contact stroke = contact_at({-0.6 + n * 0.2, 1}, Gesture::stroke, n == 6 ? Phase::up : Phase::move);
    stroke.speed_mm_s = 900;
    jacket.feel(stroke);
  }
  jacket.pass(300ms);
  EXPECT_EQ(jacket.log,
            "0: 1=0.45-200 2=0.89-200\n"
            "30: 1=0.00 2=1.00-230 3=0.42-230\n"
            "50: 3=0.40-230\n"
            "60: 2=1.00-260 3=0.63-260\n"
            "80: 3=0.58-260\n"
            "90: 2=1.00-290 3=0.68-290\n"
            "110: 3=0.65-290\n"
            "120: 2=1.00-130 3=0.65-320 4=0.34-320\n"
            "140: 4=0.38-320\n"
            "150: 3=0.65-350 4=0.50-350\n"
            "170: 4=0.54-350\n"
            "180: 3=0.65-200 4=0.60-380 5=0.16-380\n"
            "200: 5=0.00\n"
            "280: 4=0.00\n");
}

}  // namespace
}  // namespace telehug
