// SPDX-License-Identifier: Apache-2.0
//
// Golden test of the shipped jacket: touches in, exact commands out.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "doubles/fake_jacket_link.hpp"
#include "jacket/load_jacket_profile.hpp"
#include "rendering/jacket_renderer.hpp"
#include "safety/safety_stage.hpp"
#include "unit/jacket/jacket_builders.hpp"
#include "unit/jacket/wired_jacket.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int full = 148;  // step 18 of 31: the last within 0.6
constexpr Duration started = 40ms;
constexpr int least = 66;  // step 8 of 31: the first from 0.25 on

JacketProfile shipped() {
  auto profile = load_jacket_profile(TELEHUG_SOURCE "/deploy/jackets/duemilanove-16.toml");
  if (!profile) throw std::runtime_error(profile.error().message);
  return std::move(profile).value();
}

std::string text(const MotorCommands& commands) {
  std::string all;
  for (const MotorCommand& command : commands) {
    all += fmt::format("{}{}={} {}ms", all.empty() ? "" : ", ", command.channel, command.intensity,
                       to_ms(command.duration));
  }
  return all;
}

// The commands of the last frame that a single touch has caused after this time.
std::string commands_for(const Contact& contact, Duration after = {}, Rendering rendering = Rendering::boxes) {
  JacketProfile profile = shipped();
  profile.rendering = rendering;
  FakeJacket jacket;
  SafetyStage safety(std::make_unique<FakeJacketLink>(jacket), profile, {});
  Timestamp now = from_ns(1'000'000'000);
  safety.tick(now);
  safety.on_heartbeat(0, now);
  JacketRenderer renderer(profile, 200ms);
  safety.apply(0, renderer.plan(event_of(1, {contact}), {}, now).drives, now);
  if (after > 0ms) {
    now += after;
    safety.apply(0, renderer.tick(now), now);
  }
  return jacket.frames.empty() ? "" : text(jacket.frames.back().commands);
}

TEST(Duemilanove16, drives_exactly_the_motors_of_each_box) {
  const std::map<int, std::string> golden{
      {1, "0=148 200ms"},   {2, "1=148 200ms"},   {3, "1=148 200ms, 2=148 200ms"},
      {4, "2=148 200ms"},   {5, "3=148 200ms"},   {6, "4=148 200ms"},
      {7, "5=148 200ms"},   {8, "6=148 200ms"},   {9, "7=148 200ms"},
      {10, "8=148 200ms"},  {11, "9=148 200ms"},  {12, "10=148 200ms"},
      {13, "11=148 200ms"}, {14, "12=148 200ms"}, {15, "13=148 200ms"},
      {16, "9=148 200ms"},  {17, "14=148 200ms"}, {18, "14=148 200ms, 15=148 200ms"},
      {19, "15=148 200ms"}, {20, "13=148 200ms"},
  };
  for (const auto& [box, commands] : golden)
    EXPECT_EQ(commands_for(contact_in(box)), commands) << "box " << box;
}

TEST(Duemilanove16, drives_by_places_the_motors_about_the_middle_of_each_box) {
  const std::map<int, std::string> golden{
      {1, "0=148 200ms"},
      {2, "0=90 160ms, 1=148 160ms"},
      {3, "1=123 160ms, 2=123 160ms"},
      {4, "2=148 160ms, 3=90 160ms"},
      {5, "3=148 200ms"},
      {6, "0=90 160ms, 4=140 160ms"},
      {7, "5=148 200ms"},
      {8, "6=148 200ms"},
      {9, "7=148 200ms"},
      {10, "3=90 160ms, 8=140 160ms"},
      {11, "9=148 200ms"},
      {12, "10=148 200ms"},
      {13, "11=148 200ms"},
      {14, "12=148 200ms"},
      {15, "13=148 200ms"},
      {16, "9=132 160ms, 14=115 160ms"},
      {17, "9=99 160ms, 14=140 160ms"},
      {18, "14=123 160ms, 15=123 160ms"},
      {19, "13=99 160ms, 15=140 160ms"},
      {20, "13=132 160ms, 15=115 160ms"},
  };
  for (const auto& [box, commands] : golden)
    EXPECT_EQ(commands_for(contact_in(box), started, Rendering::places), commands) << "box " << box;
}

TEST(Duemilanove16, sends_a_touch_below_its_last_row_to_the_nearest_motor) {
  Contact below = contact_in(22);
  below.grid = {5, 6};
  EXPECT_EQ(commands_for(below), "14=148 200ms");
}

TEST(Duemilanove16, spreads_strength_between_the_least_that_turns_and_the_most_allowed) {
  const std::map<double, int> golden{{0.0, 0}, {0.001, least}, {0.25, 90}, {0.5, 107}, {1.0, full}, {7.0, full}};
  for (const auto& [strength, intensity] : golden) {
    Contact touch = contact_in(8);
    touch.strength = strength;
    const std::string expected = intensity == 0 ? "" : fmt::format("6={} 160ms", intensity);
    EXPECT_EQ(commands_for(touch, started), strength < 1 ? expected : fmt::format("6={} 200ms", full))
        << "strength " << strength;
  }
}

TEST(Duemilanove16, starts_its_motors_with_all_that_is_allowed) {
  Contact touch = contact_in(8);
  touch.strength = 0.25;
  EXPECT_EQ(commands_for(touch), fmt::format("6={} 60ms", full)) << "and off by itself if nobody comes back";
}

TEST(Duemilanove16, says_a_tap_between_two_motors_in_these_bytes) {
  WiredJacket jacket("duemilanove-16.toml");
  Contact tap = contact_in(13);
  tap.body = {0.25, 1.25};
  jacket.feel(tap);
  jacket.pass(30ms);
  tap.phase = Phase::up;
  tap.gesture = Gesture::tap;
  jacket.feel(tap);
  jacket.pass(300ms);
  EXPECT_EQ(jacket.log,
            "0: 0b 10 06 0b 94 06 0c 94 06 90 27 00\n"
            "30: 0b 10 07 0b 94 03 0c 94 03 11 73 00\n"
            "40: 0b 10 08 0b 7b 06 0c 7b 06 61 4b 00\n"
            "90: 0b 10 09 0b 7b 01 0c 7b 01 ca d2 00\n");
}

TEST(Duemilanove16, covers_four_rows_with_all_sixteen_channels) {
  const JacketProfile profile = shipped();
  EXPECT_THAT(profile.notes, IsEmpty());
  ASSERT_EQ(profile.actuators.size(), 16U);
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_EQ(profile.actuators[i].channel, i);
}

TEST(Duemilanove16, places_every_motor_in_a_box_that_it_serves_and_on_the_side_that_its_name_tells) {
  for (const Actuator& actuator : shipped().actuators) {
    const bool inside = std::ranges::any_of(actuator.boxes, [&](int box) {
      return std::abs(actuator.place.x_fh - middle_of(box).x_fh) <= 0.25 &&
             std::abs(actuator.place.y_fh - middle_of(box).y_fh) <= 0.25;
    });
    EXPECT_TRUE(inside) << actuator.name;
    if (actuator.name.starts_with("right")) {
      EXPECT_LT(actuator.place.x_fh, 0) << actuator.name;
    }
    if (actuator.name.starts_with("left")) {
      EXPECT_GT(actuator.place.x_fh, 0) << actuator.name;
    }
  }
}

TEST(Duemilanove16, keeps_motors_far_enough_apart_to_be_told_from_each_other) {
  const JacketProfile profile = shipped();
  for (const Actuator& one : profile.actuators) {
    for (const Actuator& other : profile.actuators) {
      if (one.id >= other.id) continue;
      EXPECT_GE(std::hypot(one.place.x_fh - other.place.x_fh, one.place.y_fh - other.place.y_fh), 0.4)
          << one.name << " and " << other.name;
    }
  }
}

}  // namespace
}  // namespace telehug
