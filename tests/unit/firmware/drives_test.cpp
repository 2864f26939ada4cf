// SPDX-License-Identifier: Apache-2.0
//
// What the firmware does to its pins, in cycles of the simulated microcontroller.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/firmware/virtual_jacket.hpp"

namespace telehug {
namespace {

using protocol::FrameType;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::uint8_t full = 255;
constexpr std::uint8_t longest_10ms = 25;
constexpr std::uint64_t ten_periods = 158'720;  // of 992 us

TEST(FirmwareDrives, MovesNothingBeforeAHello) {
  VirtualJacket jacket;
  jacket.say(FrameType::set, {3, full, longest_10ms});
  FramePayload all(18, full);
  jacket.say(FrameType::set_all, all);
  jacket.say(FrameType::keep);
  jacket.chip.run_ms(50);
  EXPECT_THAT(jacket.channels_that_rose_since(0), IsEmpty());
  EXPECT_FALSE(jacket.chip.armed_led());
}

TEST(FirmwareDrives, LeadsEachChannelToItsOwnPin) {
  for (std::uint8_t channel = 0; channel < protocol::motor_count; ++channel) {
    VirtualJacket jacket;
    jacket.hello();
    jacket.say(FrameType::set, {channel, full, 5});
    jacket.chip.run_ms(100);
    EXPECT_THAT(jacket.channels_that_rose_since(0), ElementsAre(channel));
  }
}

TEST(FirmwareDrives, TogglesThePinsThatASetNamesAndNoOthers) {
  VirtualJacket jacket;
  jacket.hello();
  jacket.say(FrameType::set, {3, full, longest_10ms, 7, 100, longest_10ms, 12, 1, longest_10ms});
  jacket.chip.run_ms(100);
  EXPECT_THAT(jacket.channels_that_rose_since(0), ElementsAre(3, 7, 12));
}

TEST(FirmwareDrives, LeavesAloneWhatALaterSetDoesNotName) {
  VirtualJacket jacket;
  jacket.hello();
  jacket.say(FrameType::set, {3, full, longest_10ms});
  jacket.chip.run_ms(20);
  const auto second = jacket.say(FrameType::set, {5, full, longest_10ms});
  jacket.chip.run_ms(20);
  EXPECT_TRUE(jacket.chip.is_high(3));
  EXPECT_TRUE(jacket.chip.is_high(5));
  jacket.say(FrameType::set, {3, 0, longest_10ms});
  jacket.chip.run_ms(5);
  EXPECT_FALSE(jacket.chip.is_high(3));
  EXPECT_TRUE(jacket.chip.is_high(5));
  EXPECT_THAT(jacket.channels_that_rose_since(second), ElementsAre(5));
}

TEST(FirmwareDrives, ShowsTwoSetsOfTheSameMillisecondBoth) {
  VirtualJacket jacket;
  jacket.hello();
  for (int attempt = 0; attempt < 20; ++attempt) {
    EncodedFrame both = encode({FrameType::set, ++jacket.sequence, {1, full, 3}});
    const EncodedFrame second = encode({FrameType::set, ++jacket.sequence, {2, full, 3}});
    both.insert(both.end(), second.begin(), second.end());
    const auto from = jacket.chip.cycle();
    jacket.say_bytes({both.data(), both.size()});
    jacket.chip.run_cycles(70 * jacket_cycles_per_ms + 1000);
    EXPECT_THAT(jacket.channels_that_rose_since(from), ElementsAre(1, 2));
  }
}

TEST(FirmwareDrives, StartWithinThreeMillisecondsOfTheLastByte) {
  VirtualJacket jacket;
  jacket.hello();
  const auto said = jacket.say(FrameType::set, {4, full, 5});
  jacket.chip.run_ms(20);
  const auto rise = std::ranges::find_if(jacket.edges, [](const PinEdge& edge) { return edge.high; });
  ASSERT_NE(rise, jacket.edges.end());
  EXPECT_LE(to_ms(rise->cycle - said), 3.0);
}

TEST(FirmwareDrives, EndByThemselvesAtTheDurationThatWasGiven) {
  VirtualJacket jacket;
  jacket.hello();
  const auto said = jacket.say(FrameType::set, {4, full, 10});
  jacket.chip.run_ms(200);
  EXPECT_LE(to_ms(jacket.last_high(4) - said), 101.0);
  EXPECT_GE(to_ms(jacket.last_high(4) - said), 97.0);
}

TEST(FirmwareDrives, NeverOutlastTheLastSetByMoreThan250MillisecondsWhateverItAskedFor) {
  VirtualJacket jacket;
  jacket.hello();
  std::uint64_t said = 0;
  for (int i = 0; i < 10; ++i) {
    said = jacket.say(FrameType::set, {0, full, 255, 15, 8, 255});
    jacket.chip.run_ms(30);
  }
  jacket.run_kept_alive_ms(600);
  EXPECT_FALSE(jacket.anything_high());
  for (const std::uint8_t channel : {std::uint8_t{0}, std::uint8_t{15}}) {
    EXPECT_LE(to_ms(jacket.last_high(channel) - said), 250.0);
    EXPECT_GE(to_ms(jacket.last_high(channel) - said), 240.0);
  }
}

TEST(FirmwareDrives, OfAllMotorsAreCutTo250MillisecondsToo) {
  VirtualJacket jacket;
  jacket.hello();
  FramePayload payload(16, full);
  payload.push_back(0xFF);
  payload.push_back(0xFF);
  const auto said = jacket.say(FrameType::set_all, payload);
  jacket.chip.run_ms(100);
  EXPECT_EQ(jacket.channels_that_rose_since(0).size(), 16U);
  jacket.run_kept_alive_ms(400);
  for (std::uint8_t channel = 0; channel < 16; ++channel) {
    EXPECT_LE(to_ms(jacket.last_high(channel) - said), 250.0);
  }
}

TEST(FirmwareDrives, EndWhenTheMainLoopHangs) {
  VirtualJacket jacket;
  jacket.hello();
  const auto said = jacket.say(FrameType::set, {4, full, longest_10ms});
  jacket.chip.run_ms(10);
  ASSERT_TRUE(jacket.chip.is_high(4));
  jacket.chip.hang_main_loop();
  jacket.chip.run_ms(300);
  EXPECT_LE(to_ms(jacket.last_high(4) - said), 150.0);
}

TEST(FirmwareDrives, AllStopAtOnceOnStopAllWhichKeepsTheJacketArmed) {
  VirtualJacket jacket;
  jacket.hello();
  FramePayload payload(16, full);
  payload.push_back(250);
  payload.push_back(0);
  jacket.say(FrameType::set_all, payload);
  jacket.chip.run_ms(20);
  ASSERT_TRUE(jacket.anything_high());
  const auto said = jacket.say(FrameType::stop_all);
  jacket.chip.run_ms(1);
  EXPECT_FALSE(jacket.anything_high());
  jacket.chip.run_ms(20);
  EXPECT_THAT(jacket.channels_that_rose_since(said + jacket_cycles_per_ms), IsEmpty());
  jacket.say(FrameType::set, {4, full, 10});
  jacket.chip.run_ms(10);
  EXPECT_TRUE(jacket.chip.is_high(4));
}

TEST(FirmwareDrives, AreAllOffWithin500MillisecondsOfTheLastFrameAndNeedANewHello) {
  VirtualJacket jacket;
  jacket.hello();
  EXPECT_TRUE(jacket.chip.armed_led());
  jacket.run_kept_alive_ms(1000);
  EXPECT_TRUE(jacket.chip.armed_led());
  const auto said = jacket.say(FrameType::keep);
  while (jacket.chip.armed_led() && to_ms(jacket.chip.cycle() - said) < 1000)
    jacket.chip.run_ms(1);
  EXPECT_LE(to_ms(jacket.chip.cycle() - said), 500.0);
  EXPECT_GE(to_ms(jacket.chip.cycle() - said), 490.0);
  const auto answer = jacket.ask(FrameType::set, {4, full, 10});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->type, FrameType::nack);
  EXPECT_EQ(answer->payload.at(1), static_cast<std::uint8_t>(protocol::NackReason::unarmed));
  EXPECT_THAT(jacket.channels_that_rose_since(said), IsEmpty());
}

TEST(FirmwareDrives, EndWithANewHello) {
  VirtualJacket jacket;
  jacket.hello();
  jacket.say(FrameType::set, {4, full, longest_10ms});
  jacket.chip.run_ms(20);
  ASSERT_TRUE(jacket.chip.is_high(4));
  jacket.say(FrameType::hello, {1, 1, 0, 0});
  jacket.chip.run_ms(2);
  EXPECT_FALSE(jacket.anything_high());
}

TEST(FirmwareDrives, AreStrongerTheHigherTheIntensity) {
  VirtualJacket jacket;
  jacket.hello();
  double before = 0;
  for (int intensity = 1; intensity <= 255; intensity += 2) {
    jacket.say(FrameType::set, {9, static_cast<std::uint8_t>(intensity), longest_10ms});
    jacket.chip.run_ms(5);
    const auto from = jacket.chip.cycle();
    jacket.chip.run_cycles(ten_periods);
    const double duty = jacket.duty_since(from, 9);
    const double level = std::max(1.0, std::round(intensity * 31 / 255.0));
    EXPECT_NEAR(duty, level / 31, 0.004) << "intensity " << intensity;
    EXPECT_GE(duty, before - 0.001) << "intensity " << intensity;
    before = duty;
  }
  EXPECT_NEAR(before, 1.0, 0.001);
}

TEST(FirmwareDrives, KeepTheirStrengthOnEveryChannelAtOnce) {
  VirtualJacket jacket;
  jacket.hello();
  FramePayload payload;
  for (std::uint8_t channel = 0; channel < 16; ++channel)
    payload.push_back(static_cast<std::uint8_t>(channel * 17));
  payload.push_back(250);
  payload.push_back(0);
  jacket.say(FrameType::set_all, payload);
  jacket.chip.run_ms(5);
  const auto from = jacket.chip.cycle();
  jacket.chip.run_cycles(ten_periods);
  for (std::uint8_t channel = 0; channel < 16; ++channel) {
    EXPECT_NEAR(jacket.duty_since(from, channel), channel * 17 / 255.0, 0.02) << "channel " << int{channel};
  }
}

}  // namespace
}  // namespace telehug
