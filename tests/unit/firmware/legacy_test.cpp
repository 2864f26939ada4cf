// SPDX-License-Identifier: Apache-2.0
//
// The board that takes bare motor numbers, as the thesis' sketch did.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/firmware/virtual_jacket.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// simavr tells the firmware of a byte one byte later than the wire.
constexpr double longest_ms = 250 + 10.0 / 9600 * 1000;

class LegacyFirmware : public ::testing::Test {
 protected:
  std::uint64_t say(std::uint8_t byte) {
    const std::array<std::uint8_t, 1> bytes{byte};
    return jacket.say_bytes(bytes);
  }

  VirtualJacket jacket{*find_board("legacy")};
};

TEST_F(LegacyFirmware, GivesEachNumberItsMotorAPulseOf250MillisecondsAtFullPower) {
  for (std::uint8_t number = 1; number <= 16; ++number) {
    const auto channel = static_cast<std::uint8_t>(number - 1);
    const auto said = say(number);
    jacket.chip.run_ms(400);
    EXPECT_THAT(jacket.channels_that_rose_since(said), ElementsAre(channel));
    EXPECT_LE(to_ms(jacket.last_high(channel) - said), longest_ms);
    EXPECT_GE(to_ms(jacket.last_high(channel) - said), 247.0);
  }
}

TEST_F(LegacyFirmware, RunsSeveralMotorsAtOnce) {
  say(3);
  say(7);
  say(16);
  jacket.chip.run_ms(5);
  EXPECT_THAT(jacket.channels_that_rose_since(0), ElementsAre(2, 6, 15));
}

TEST_F(LegacyFirmware, BeginsThePulseAnewForTheSameNumberAndEndsItAllTheSame) {
  std::uint64_t said = 0;
  for (int i = 0; i < 10; ++i) {
    said = say(5);
    jacket.chip.run_ms(100);
    EXPECT_TRUE(jacket.chip.is_high(4));
  }
  jacket.chip.run_ms(400);
  EXPECT_LE(to_ms(jacket.last_high(4) - said), longest_ms);
}

TEST_F(LegacyFirmware, IsMovedByNoOtherByteAndNeverAnswers) {
  for (int byte = 0; byte < 256; ++byte) {
    if (byte < 1 || byte > 16) say(static_cast<std::uint8_t>(byte));
  }
  jacket.chip.run_ms(100);
  EXPECT_THAT(jacket.channels_that_rose_since(0), IsEmpty());
  say(1);
  jacket.chip.run_ms(100);
  EXPECT_THAT(jacket.chip.take_output(), IsEmpty());
}

TEST_F(LegacyFirmware, MovesNothingBeforeTheFirstByte) {
  jacket.chip.run_ms(1000);
  EXPECT_THAT(jacket.channels_that_rose_since(0), IsEmpty());
}

TEST_F(LegacyFirmware, IsResetByTheWatchdogInTheMiddleOfAPulseWhenItHangs) {
  const auto said = say(9);
  jacket.chip.run_ms(10);
  jacket.chip.hang_main_loop();
  jacket.chip.run_ms(300);
  EXPECT_EQ(jacket.chip.resets(), 1U);
  EXPECT_LE(to_ms(jacket.last_high(8) - said), 150.0);
  say(9);
  jacket.chip.run_ms(5);
  EXPECT_TRUE(jacket.chip.is_high(8));
}

TEST_F(LegacyFirmware, Hears9600Baud) {
  const auto from = jacket.chip.cycle();
  const std::vector<std::uint8_t> bytes(96, 0x40);
  const auto said = jacket.say_bytes(bytes);
  EXPECT_NEAR(to_ms(said - from), 100, 2);
}

}  // namespace
}  // namespace telehug
