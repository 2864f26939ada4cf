// SPDX-License-Identifier: Apache-2.0
#include "jacket_trial.hpp"

#include <gmock/gmock.h>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

JacketProfile two_motors() {
  JacketProfile profile;
  profile.name = "Vest";
  profile.actuators.resize(2);
  profile.actuators[0].id = 3;
  profile.actuators[1].id = 4;
  profile.actuators[1].enabled = false;
  return profile;
}

std::string refusal(const Json& request) {
  const auto read = read_trial_request(request, two_motors());
  return read ? "none" : read.error().message;
}

TEST(TrialRequest, TakesAnIdAndPerhapsStrengthAndSeconds) {
  const auto plain = read_trial_request({{"id", 3U}}, two_motors());
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->actuator, 3);
  const auto full = read_trial_request({{"id", 3U}, {"strength", 0.25}, {"seconds", 2}}, two_motors());
  ASSERT_TRUE(full);
  EXPECT_EQ(full->strength, 0.25);
  EXPECT_EQ(full->duration, 2s);
}

TEST(TrialRequest, SaysWhatIsWrong) {
  EXPECT_THAT(refusal(Json::object()), HasSubstr("which actuator?"));
  for (const Json& id : {Json("3"), Json(-3), Json(3.5), Json(256U), Json(nullptr)})
    EXPECT_THAT(refusal({{"id", id}}), HasSubstr("which actuator?")) << id;
  EXPECT_THAT(refusal({{"id", 5U}}), HasSubstr("\"Vest\" has no actuator 5"));
  EXPECT_THAT(refusal({{"id", 4U}}), HasSubstr("is switched off"));
  for (const Json& strength : {Json(0), Json(1.01), Json(-1), Json("strong")})
    EXPECT_THAT(refusal({{"id", 3U}, {"strength", strength}}), HasSubstr("the strength must be")) << strength;
  for (const Json& seconds : {Json(0), Json(5.01), Json(-1), Json(true)})
    EXPECT_THAT(refusal({{"id", 3U}, {"seconds", seconds}}), HasSubstr("the seconds must be")) << seconds;
}

TEST(JacketTrial, AsksUntilItsEndAndThenOnceForNothing) {
  FakeClock clock;
  JacketTrial trial;
  EXPECT_FALSE(trial.drive(clock.now(), 200ms));
  trial.begin({3, 0.5, 1s}, clock.now());
  auto drive = trial.drive(clock.now(), 200ms);
  ASSERT_TRUE(drive);
  EXPECT_EQ(drive->actuator, 3);
  EXPECT_EQ(drive->strength, 0.5);
  EXPECT_EQ(drive->end, clock.now() + 200ms);
  clock.advance(900ms);
  drive = trial.drive(clock.now(), 200ms);
  ASSERT_TRUE(drive);
  EXPECT_EQ(drive->end, clock.now() + 100ms) << "no longer than was asked for";
  clock.advance(100ms);
  drive = trial.drive(clock.now(), 200ms);
  ASSERT_TRUE(drive);
  EXPECT_EQ(drive->strength, 0);
  EXPECT_FALSE(trial.drive(clock.now(), 200ms));
}

TEST(JacketTrial, EndsWhenTheClockJumpsBack) {
  FakeClock clock;
  clock.advance(1h);
  JacketTrial trial;
  trial.begin({3, 0.5, 1s}, clock.now());
  const auto drive = trial.drive(clock.now() - 30min, 200ms);
  ASSERT_TRUE(drive);
  EXPECT_EQ(drive->strength, 0);
}

TEST(JacketTrial, GivesWayToANewOne) {
  FakeClock clock;
  JacketTrial trial;
  trial.begin({3, 0.5, 1s}, clock.now());
  trial.begin({4, 0.5, 1s}, clock.now());
  EXPECT_EQ(trial.drive(clock.now(), 200ms)->actuator, 4);
}

}  // namespace
}  // namespace telehug
