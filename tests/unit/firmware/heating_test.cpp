// SPDX-License-Identifier: Apache-2.0
//
// What the firmware does with heaters that work as they should.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/firmware/warm_jacket.hpp"

namespace telehug {
namespace {

using protocol::FrameType;
using protocol::HeaterFault;
using protocol::NackReason;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::uint8_t full = 255;

void expect_nack(const std::optional<Frame>& answer, NackReason reason) {
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->type, FrameType::nack);
  EXPECT_EQ(answer->payload.at(1), static_cast<std::uint8_t>(reason));
}

FramePayload joined(FramePayload first, const FramePayload& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

TEST(FirmwareHeating, IsToldInTheCapabilitiesWithItsTemperatures) {
  WarmJacket jacket;
  const auto caps = parse_caps(jacket.hello().value());
  ASSERT_TRUE(caps);
  EXPECT_EQ(caps->motors, 12);
  EXPECT_EQ(caps->heaters, 2);
  EXPECT_EQ(caps->temperatures, 2);
}

TEST(FirmwareHeating, LeavesTwelveMotorsEachOnItsOwnPin) {
  for (std::uint8_t channel = 0; channel < 12; ++channel) {
    WarmJacket jacket;
    jacket.hello();
    jacket.say(FrameType::set, {channel, full, 5});
    jacket.run_ms(100);
    EXPECT_THAT(jacket.channels_that_rose_since(0), ElementsAre(channel));
  }
}

TEST(FirmwareHeating, RefusesMotorsThatTheBoardLacks) {
  WarmJacket jacket;
  jacket.hello();
  expect_nack(jacket.ask(FrameType::set, {3, full, 9, 12, full, 9}), NackReason::bad_channel);
  FramePayload all(18, 0);
  all[2] = full;
  all[16] = 200;
  all[13] = 1;
  expect_nack(jacket.ask(FrameType::set_all, all), NackReason::bad_channel);
  EXPECT_THAT(jacket.channels_that_rose_since(0), IsEmpty());
  all[13] = 0;
  EXPECT_EQ(jacket.ask(FrameType::set_all, all)->type, FrameType::ack);
  EXPECT_THAT(jacket.channels_that_rose_since(0), ElementsAre(2));
}

TEST(FirmwareHeating, HoldsEachSetPointWithinHalfADegree) {
  WarmJacket jacket;
  jacket.hello();
  jacket.run_heated_s(90, {38, 36});
  double coldest = 100;
  double warmest = 0;
  for (int i = 0; i < 30; ++i) {
    jacket.run_heated_s(1, {38, 36});
    EXPECT_NEAR(jacket.pad(0), 38, 0.5);
    EXPECT_NEAR(jacket.pad(1), 36, 0.5);
    coldest = std::min(coldest, jacket.pad(0));
    warmest = std::max(warmest, jacket.pad(0));
  }
  std::cout << "[ measured ] held at 38 C: " << coldest << " to " << warmest << " C\n";
  for (const std::uint8_t heater : {std::uint8_t{0}, std::uint8_t{1}}) {
    EXPECT_EQ(jacket.heater_telemetry(heater).fault, HeaterFault::none);
    EXPECT_NEAR(jacket.heater_telemetry(heater).celsius, jacket.pad(heater), 0.4);
  }
}

TEST(FirmwareHeating, MeetsItsHighestSetPointWithoutAFault) {
  WarmJacket jacket;
  jacket.hello();
  jacket.run_heated_s(150, {40, 40});
  EXPECT_EQ(jacket.heater_telemetry(0).fault, HeaterFault::none);
  EXPECT_GE(jacket.pad(0), 39.5);
  EXPECT_LE(jacket.warmest_pad[0], 40.5);
}

TEST(FirmwareHeating, IsOffBeforeAHello) {
  WarmJacket jacket;
  expect_nack(jacket.heat(0, 38), NackReason::unarmed);
  jacket.run_ms(300);
  EXPECT_THAT(jacket.channels_that_rose_since(0), IsEmpty());
}

TEST(FirmwareHeating, AppliesNothingOfAFrameInWhichAnyPartIsWrong) {
  WarmJacket jacket;
  jacket.hello();
  const auto good = WarmJacket::heat_payload(0, 38);
  expect_nack(jacket.ask(FrameType::heat, joined(good, WarmJacket::heat_payload(1, 40.1))), NackReason::bad_value);
  expect_nack(jacket.ask(FrameType::heat, joined(good, WarmJacket::heat_payload(1, 6553.5))), NackReason::bad_value);
  expect_nack(jacket.ask(FrameType::heat, joined(good, WarmJacket::heat_payload(2, 38))), NackReason::bad_channel);
  expect_nack(jacket.ask(FrameType::heat, joined(good, WarmJacket::heat_payload(255, 38))), NackReason::bad_channel);
  expect_nack(jacket.ask(FrameType::heat, {0, 0x7C, 1}), NackReason::bad_length);
  expect_nack(jacket.ask(FrameType::heat), NackReason::bad_length);
  jacket.run_ms(300);
  EXPECT_THAT(jacket.channels_that_rose_since(0), IsEmpty());
  EXPECT_EQ(jacket.heat(0, 40)->type, FrameType::ack);
  jacket.run_ms(50);
  EXPECT_THAT(jacket.channels_that_rose_since(0), ElementsAre(16));
}

TEST(FirmwareHeating, EndsByItselfAfter250MillisecondsAtMost) {
  WarmJacket jacket;
  jacket.hello();
  for (const auto& [asked_10ms, least, most] : {std::tuple{255, 240.0, 250.0}, {10, 95.0, 101.0}, {0, 0.0, 0.0}}) {
    const auto from = jacket.chip.cycle();
    const auto said =
        jacket.say(FrameType::heat, WarmJacket::heat_payload(0, 38, static_cast<std::uint8_t>(asked_10ms)));
    jacket.chip.run_ms(300);
    const auto last = std::max(jacket.last_high(16), from);
    EXPECT_LE(last <= said ? 0 : to_ms(last - said), most) << asked_10ms;
    EXPECT_GE(last <= said ? 0 : to_ms(last - said), least) << asked_10ms;
    jacket.say(FrameType::keep);
  }
}

TEST(FirmwareHeating, StopsWithinAMillisecondOfAStopAllAndOfAHello) {
  for (const FrameType type : {FrameType::stop_all, FrameType::hello}) {
    WarmJacket jacket;
    jacket.hello();
    jacket.run_heated_s(1, {38, 38});
    ASSERT_TRUE(jacket.is_heating(0));
    ASSERT_TRUE(jacket.is_heating(1));
    const auto said = jacket.say(type, type == FrameType::hello ? FramePayload{1, 1, 0, 0} : FramePayload{});
    jacket.chip.run_ms(1);
    EXPECT_FALSE(jacket.anything_high());
    jacket.run_ms(300);
    EXPECT_THAT(jacket.channels_that_rose_since(said + jacket_cycles_per_ms / 4), IsEmpty());
  }
}

TEST(FirmwareHeating, CoolsDownFor5MinutesAfter10AndNeitherAHelloNorAResetEndsThat) {
  WarmJacket jacket;
  jacket.hello();
  // A pause gives back twice of itself.
  jacket.run_heated_s(100, {36, 0});
  jacket.run_heated_s(55, {0, 0});

  const auto begun = jacket.chip.cycle();
  jacket.run_heated_s(595, {36, 0});
  EXPECT_EQ(jacket.heater_telemetry(0).fault, HeaterFault::none);
  for (int i = 0; i < 50 && jacket.heater_telemetry(0).fault == HeaterFault::none; ++i)
    jacket.run_heated_s(0.2, {36, 0});
  EXPECT_EQ(jacket.heater_telemetry(0).fault, HeaterFault::cooling_down);
  const auto cooling_since = jacket.chip.cycle();
  std::cout << "[ measured ] on for " << to_ms(cooling_since - begun) / 1000 << " s\n";
  EXPECT_LE(to_ms(cooling_since - begun), 600'500);

  jacket.hello();
  jacket.run_heated_s(100, {36, 0});
  jacket.chip.reset();
  jacket.run_ms(300);
  jacket.hello();
  EXPECT_EQ(jacket.heater_telemetry(0).fault, HeaterFault::cooling_down);
  EXPECT_EQ(jacket.heater_telemetry(1).fault, HeaterFault::none);
  jacket.run_heated_s(295 - to_ms(jacket.chip.cycle() - cooling_since) / 1000, {36, 0});
  EXPECT_LE(jacket.last_high(16), cooling_since);
  ASSERT_TRUE(jacket.ms_until([&] { return jacket.is_heating(0); }, {36, 0}, 10));
  std::cout << "[ measured ] off for " << to_ms(jacket.chip.cycle() - cooling_since) / 1000 << " s\n";
}

TEST(FirmwareHeating, TellsEveryTemperatureWithinAFifthOfADegreeAtAnySupply) {
  for (const unsigned supply_mv : {4500U, 5000U, 5500U}) {
    WarmJacket jacket;
    jacket.chip.heaters().set_supply_mv(supply_mv);
    for (double celsius = -18; celsius <= 78; celsius += 3.1) {
      const double ratio = std::exp(3950 * (1 / (celsius + 273.15) - 1 / 298.15));
      jacket.chip.heaters().disturb(0, static_cast<unsigned>(std::lround(supply_mv * ratio / (ratio + 1))), 1000);
      jacket.run_ms(150);
      // Beyond 55 C a step of the converter is more than a fifth of a degree.
      EXPECT_NEAR(jacket.heater_telemetry(0).celsius, celsius, celsius > 55 ? 0.5 : 0.2) << supply_mv << " mV";
    }
  }
}

TEST(FirmwareHeating, TellsTheSupplyOfEveryBoardThatAnswers) {
  for (const char* const board : {"motors16", "motors12_heaters2"}) {
    VirtualJacket jacket(*find_board(board));
    for (const unsigned supply_mv : {4400U, 5000U, 5300U}) {
      jacket.chip.heaters().set_supply_mv(supply_mv);
      jacket.chip.run_ms(100);
      const auto answer = jacket.ask(FrameType::status).value();
      EXPECT_NEAR(answer.payload.at(10) | answer.payload.at(11) << 8, supply_mv, 25) << board;
    }
  }
}

TEST(FirmwareHeating, LeavesTheMotorsTheirStrength) {
  WarmJacket jacket;
  jacket.hello();
  FramePayload payload;
  for (std::uint8_t channel = 0; channel < 16; ++channel)
    payload.push_back(static_cast<std::uint8_t>(channel < 12 ? channel * 17 : 0));
  payload.push_back(250);
  payload.push_back(0);
  jacket.hold({38, 38});
  jacket.say(FrameType::set_all, payload);
  jacket.run_ms(5);
  const auto from = jacket.chip.cycle();
  jacket.chip.run_cycles(158'720);  // ten periods of the modulation
  for (std::uint8_t channel = 0; channel < 12; ++channel) {
    EXPECT_NEAR(jacket.duty_since(from, channel), channel * 17 / 255.0, 0.02) << "channel " << int{channel};
  }
}

}  // namespace
}  // namespace telehug
