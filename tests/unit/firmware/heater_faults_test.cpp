// SPDX-License-Identifier: Apache-2.0
//
// What the firmware does with heaters and thermistors that break. WarmJacket asserts throughout that no heater's pin is
// high at more than 41 C, unarmed, or after its drive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "unit/firmware/warm_jacket.hpp"

namespace telehug {
namespace {

using protocol::FrameType;
using protocol::HeaterFault;

constexpr unsigned one_reading = 12;        // samples
constexpr std::uint64_t one_round_ms = 36;  // all inputs of the converter
constexpr unsigned many = 1000;
constexpr unsigned open_mv = 5000;
constexpr unsigned short_mv = 0;

// Of a thermistor on its divider at 5 V.
unsigned mv_at(double celsius) {
  const double ratio = std::exp(3950 * (1 / (celsius + 273.15) - 1 / 298.15));
  return static_cast<unsigned>(std::lround(5000 * ratio / (ratio + 1)));
}

class FirmwareHeaterFaults : public ::testing::Test {
 protected:
  FirmwareHeaterFaults() {
    jacket.hello();
    jacket.run_heated_s(5, {38, 0});
  }

  HeaterFault fault(std::uint8_t heater = 0) { return jacket.heater_telemetry(heater).fault; }

  // Whether the heater has power in the next two seconds in which it is wanted.
  bool heats(std::uint8_t heater = 0) {
    return jacket.ms_until([&] { return jacket.is_heating(heater); }, {38, 38}, 2).has_value();
  }

  WarmJacket jacket;
};

TEST_F(FirmwareHeaterFaults, OfAnOpenSensorTurnOffItsHeaterAndNotTheOther) {
  jacket.break_now(0, HeaterBreak::open);
  jacket.run_heated_s(0.4, {38, 0});
  EXPECT_EQ(fault(0), HeaterFault::sensor_open);
  EXPECT_TRUE(std::isnan(jacket.heater_telemetry(0).celsius));
  EXPECT_FALSE(heats(0));
  EXPECT_EQ(fault(1), HeaterFault::none);
  EXPECT_TRUE(heats(1));
}

TEST_F(FirmwareHeaterFaults, OfAShortedSensorTurnOffItsHeaterAndNotTheOther) {
  jacket.break_now(0, HeaterBreak::shorted);
  jacket.run_heated_s(0.4, {38, 0});
  EXPECT_EQ(fault(0), HeaterFault::sensor_short);
  EXPECT_FALSE(heats(0));
  EXPECT_EQ(fault(1), HeaterFault::none);
  EXPECT_TRUE(heats(1));
}

TEST_F(FirmwareHeaterFaults, TakeThePowerAwayAtTheFirstReadingThatShowsThem) {
  for (const unsigned wrong_mv : {open_mv, short_mv, mv_at(60)}) {
    for (std::uint64_t phase_ms = 0; phase_ms < one_round_ms; phase_ms += 5) {
      jacket.run_heated_s(0.2, {38, 0});
      jacket.run_ms(phase_ms);
      ASSERT_TRUE(jacket.is_heating(0));
      jacket.chip.heaters().disturb(0, wrong_mv, many);
      jacket.run_ms(one_round_ms + 1);
      EXPECT_FALSE(jacket.is_heating(0)) << wrong_mv << " mV at " << phase_ms << " ms";
      jacket.chip.reset();
      jacket.chip.heaters().disturb(0, 0, 0);
      jacket.run_ms(300);
      jacket.hello();
    }
  }
}

TEST_F(FirmwareHeaterFaults, LastThroughAHelloAndEndWithAReset) {
  jacket.chip.heaters().disturb(0, open_mv, 5 * one_reading);
  jacket.run_heated_s(1, {38, 0});
  ASSERT_EQ(fault(), HeaterFault::sensor_open);
  EXPECT_NEAR(jacket.heater_telemetry(0).celsius, jacket.pad(0), 1) << "the sensor is well again";
  jacket.hello();
  EXPECT_EQ(fault(), HeaterFault::sensor_open);
  EXPECT_FALSE(heats());
  jacket.chip.reset();
  jacket.run_ms(300);
  jacket.hello();
  EXPECT_EQ(fault(), HeaterFault::none);
  EXPECT_TRUE(heats());
}

TEST_F(FirmwareHeaterFaults, AreNotMadeOfASampleThatIsWrong) {
  for (const unsigned wrong_mv : {open_mv, short_mv, mv_at(60), mv_at(5)}) {
    for (int i = 0; i < 40; ++i) {
      jacket.chip.heaters().disturb(0, wrong_mv, 1);
      jacket.hold({38, 0});
      jacket.run_ms(one_round_ms + 1);
      EXPECT_TRUE(jacket.is_heating(0));
    }
  }
  EXPECT_EQ(fault(), HeaterFault::none);
}

TEST_F(FirmwareHeaterFaults, AreNotMadeOfAReadingThatIsWrong) {
  for (const unsigned wrong_mv : {open_mv, short_mv, mv_at(60), mv_at(5)}) {
    for (std::uint64_t i = 0; i < 40; ++i) {
      jacket.run_ms(i);  // anywhere in a reading
      jacket.chip.heaters().disturb(0, wrong_mv, many);
      jacket.run_heated_s(0.011, {38, 0});
      jacket.chip.heaters().disturb(0, 0, 0);
      jacket.run_heated_s(0.15, {38, 0});
    }
    EXPECT_EQ(fault(), HeaterFault::none) << wrong_mv << " mV";
  }
  EXPECT_TRUE(heats());
}

TEST_F(FirmwareHeaterFaults, AreNotHiddenByAReadingThatIsRight) {
  jacket.break_now(0, HeaterBreak::open);
  for (int i = 0; i < 4; ++i) {
    jacket.chip.heaters().disturb(0, mv_at(34), one_reading);  // of three
    jacket.hold({38, 0});
    jacket.run_ms(3 * one_round_ms);
  }
  EXPECT_EQ(fault(), HeaterFault::sensor_open);
}

TEST_F(FirmwareHeaterFaults, CutEveryHeaterOffAt41Degrees) {
  jacket.run_heated_s(60, {38, 38});
  jacket.chip.heaters().patch(0).parameters.skin_celsius = 50;  // a bottle of hot water on it
  const auto off =
      jacket.ms_until([&] { return jacket.chip.heaters().patch(0).sensor_celsius() >= 41; }, {38, 38}, 100);
  ASSERT_TRUE(off);
  jacket.run_ms(200);
  EXPECT_EQ(fault(0), HeaterFault::too_hot);
  EXPECT_EQ(fault(1), HeaterFault::too_hot);
  EXPECT_FALSE(heats(0));
  EXPECT_FALSE(heats(1));
}

TEST_F(FirmwareHeaterFaults, TellATooHotPadAlsoWhenNothingHeatsIt) {
  jacket.chip.heaters().patch(1).parameters.skin_celsius = 60;
  jacket.run_heated_s(60, {0, 0});
  EXPECT_EQ(fault(1), HeaterFault::too_hot);
}

TEST_F(FirmwareHeaterFaults, OfASensorThatComesOffAWarmPadEndBefore41Degrees) {
  jacket.run_heated_s(60, {40, 0});
  jacket.break_now(0, HeaterBreak::detached);
  const auto ms = jacket.ms_until([&] { return jacket.pad(0) > 41; }, {40, 0}, 30);
  EXPECT_FALSE(ms);
  EXPECT_EQ(fault(), HeaterFault::no_rise);
  EXPECT_FALSE(heats());
  std::cout << "[ measured ] sensor off a pad of 40 C: at most " << jacket.warmest_pad[0] << " C\n";
}

TEST_F(FirmwareHeaterFaults, OfASensorThatLiesInTheWarmEndBefore41DegreesToo) {
  jacket.run_heated_s(60, {38, 0});
  jacket.chip.heaters().patch(0).parameters.air_celsius = 34;  // between the clothes
  jacket.break_now(0, HeaterBreak::detached);
  jacket.run_heated_s(40, {38, 0});
  EXPECT_EQ(fault(), HeaterFault::no_rise);
  EXPECT_LE(jacket.warmest_pad[0], 41);
  std::cout << "[ measured ] sensor off a pad of 38 C, between clothes of 34 C: at most " << jacket.warmest_pad[0]
            << " C\n";
}

TEST_F(FirmwareHeaterFaults, OfASensorThatWasNeverOnItsPadAreFoundBeforeThePadIsHot) {
  WarmJacket other;
  other.chip.heaters().patch(0).parameters.air_celsius = 30;
  other.break_now(0, HeaterBreak::detached);
  other.run_ms(30'000);
  other.hello();
  other.run_heated_s(40, {33, 0});
  EXPECT_EQ(other.heater_telemetry(0).fault, HeaterFault::no_rise);
  EXPECT_LE(other.warmest_pad[0], 38);
}

TEST_F(FirmwareHeaterFaults, OfASensorThatHasComeOffAreFoundThoughTheSetPointIsNotAlwaysTheSame) {
  WarmJacket other;
  other.chip.heaters().patch(0).parameters.air_celsius = 34;
  other.break_now(0, HeaterBreak::detached);
  other.run_ms(30'000);
  other.hello();
  for (int i = 0; i < 6; ++i) {
    other.run_heated_s(10, {40, 0});
    other.run_heated_s(0.4, {33, 0});
  }
  EXPECT_EQ(other.heater_telemetry(0).fault, HeaterFault::no_rise);
  EXPECT_LE(other.warmest_pad[0], 39);
}

TEST_F(FirmwareHeaterFaults, AreNotMadeOfAHeaterThatIsSlowInTheCold) {
  jacket.chip.heaters().patch(0).parameters.air_celsius = 5;
  jacket.chip.heaters().patch(0).parameters.skin_celsius = 30;
  jacket.run_heated_s(120, {36, 0});
  EXPECT_EQ(fault(), HeaterFault::none);
  EXPECT_NEAR(jacket.pad(0), 36, 0.5);
}

TEST_F(FirmwareHeaterFaults, AreNotMadeOfAHeaterThatHasToWorkHardToHoldItsSetPoint) {
  jacket.chip.heaters().patch(0).parameters.air_celsius = -10;
  jacket.chip.heaters().patch(0).parameters.skin_celsius = 30;
  jacket.run_heated_s(240, {35, 0});  // with power for 90 % of the time
  EXPECT_EQ(fault(), HeaterFault::none);
  EXPECT_NEAR(jacket.pad(0), 35, 0.5);
}

TEST_F(FirmwareHeaterFaults, AreNotMadeOfTouchesThatComeAndGo) {
  for (int i = 0; i < 40; ++i) {
    jacket.run_heated_s(1, {40, 0});
    jacket.run_heated_s(2, {0, 0});
  }
  EXPECT_EQ(fault(), HeaterFault::none);
}

TEST_F(FirmwareHeaterFaults, OfAHeaterAtFarTooHighAVoltageEndBefore41Degrees) {
  jacket.break_now(0, HeaterBreak::overvoltage);
  jacket.run_heated_s(10, {38, 0});
  EXPECT_EQ(fault(), HeaterFault::rises_too_fast);
  EXPECT_FALSE(heats());
  EXPECT_LE(jacket.warmest_pad[0], 41);
}

TEST_F(FirmwareHeaterFaults, OfATransistorThatAlwaysConductsHeatNothingThatIsOff) {
  jacket.break_now(0, HeaterBreak::runaway);
  const double before = jacket.pad(0);
  jacket.run_heated_s(30, {0, 0});
  EXPECT_LT(jacket.pad(0), before);
}

TEST_F(FirmwareHeaterFaults, OfATransistorThatAlwaysConductsCutOffTheCommonSupplyAt41Degrees) {
  jacket.run_heated_s(60, {40, 0});
  jacket.break_now(0, HeaterBreak::runaway);
  jacket.run_heated_s(60, {40, 40});  // the other one needs its power for long
  EXPECT_EQ(fault(0), HeaterFault::too_hot);
  EXPECT_EQ(fault(1), HeaterFault::too_hot);
  EXPECT_LE(jacket.warmest_pad[0], 41.5);
  EXPECT_FALSE(jacket.chip.heaters().patch(0).fuse_has_opened());
  std::cout << "[ measured ] transistor shorted beside a heater that warms: at most " << jacket.warmest_pad[0]
            << " C\n";
  jacket.run_heated_s(20, {40, 40});
  EXPECT_LT(jacket.pad(0), 40);
}

// What WarmJacket asserts, in whatever order things come.
TEST(FirmwareHeaterFaultsAtRandom, LetNoHeaterRunThatMustNot) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    WarmJacket jacket;
    std::mt19937 random(seed);
    const auto one_of = [&](int count) { return std::uniform_int_distribution(0, count - 1)(random); };
    jacket.hello();
    for (int i = 0; i < 120; ++i) {
      const auto heater = static_cast<std::uint8_t>(one_of(2));
      switch (one_of(14)) {
        case 0:
          jacket.hello();
          break;
        case 1:
          jacket.say(FrameType::stop_all);
          break;
        case 2:
          jacket.chip.mute_input(one_of(2) == 0);
          break;
        case 3:
          jacket.chip.heaters().disturb(heater, static_cast<unsigned>(one_of(5001)), static_cast<unsigned>(one_of(60)));
          break;
        case 4:
          jacket.chip.heaters().patch(heater).parameters.skin_celsius = 25 + one_of(30);
          break;
        case 5:
          if (i > 60) jacket.break_now(heater, static_cast<HeaterBreak>(one_of(5)));
          break;
        case 6:
          jacket.chip.hang_main_loop();
          jacket.run_ms(150);
          break;
        case 7:
          jacket.chip.reset();
          break;
        default:
          jacket.hold({30.0 + one_of(11), 30.0 + one_of(11)});
      }
      jacket.run_ms(static_cast<std::uint64_t>(one_of(250)));
    }
  }
}

}  // namespace
}  // namespace telehug
