// SPDX-License-Identifier: Apache-2.0
//
// The simulated pads, and how their faults are written on the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "simulator/board_wiring.hpp"
#include "simulator/heated_patch.hpp"
#include "simulator/heater_faults.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

double lag_s(const PatchParameters& p) {
  return p.pad_j_per_k / (p.to_skin_w_per_k + p.to_air_w_per_k);
}

TEST(HeatedPatch, WarmsTowardsTheBalanceOfItsPowerAndItsLosses) {
  const PatchParameters p{.fuse_celsius = 100};
  HeatedPatch patch(p);
  const double cold =
      (p.to_skin_w_per_k * p.skin_celsius + p.to_air_w_per_k * p.air_celsius) / (p.to_skin_w_per_k + p.to_air_w_per_k);
  const double gain = p.heater_w / (p.to_skin_w_per_k + p.to_air_w_per_k);
  EXPECT_NEAR(patch.pad_celsius(), cold, 0.01);
  patch.advance(lag_s(p), true);
  EXPECT_NEAR(patch.pad_celsius(), cold + gain * (1 - std::exp(-1)), 0.01);
  patch.advance(20 * lag_s(p), true);
  EXPECT_NEAR(patch.pad_celsius(), cold + gain, 0.01);
  patch.advance(20 * lag_s(p), false);
  EXPECT_NEAR(patch.pad_celsius(), cold, 0.01);
}

TEST(HeatedPatch, HasASensorThatFollowsItsPadLate) {
  HeatedPatch patch;
  patch.advance(10, true);
  EXPECT_LT(patch.sensor_celsius(), patch.pad_celsius());
  EXPECT_NEAR(patch.sensor_celsius(), patch.pad_celsius() - 0.24 * patch.parameters.sensor_lag_s, 0.05);
}

TEST(HeatedPatch, OpensItsFuseForGood) {
  HeatedPatch patch;
  patch.break_it(HeaterBreak::overvoltage);
  patch.advance(20, true);
  EXPECT_TRUE(patch.fuse_has_opened());
  EXPECT_LE(patch.pad_celsius(), patch.parameters.fuse_celsius + 0.2);
  patch.advance(600, true);
  EXPECT_LE(patch.pad_celsius(), 31);
}

TEST(HeatedPatch, HasAThermistorOf10KiloohmAt25Degrees) {
  PatchParameters p;
  p.skin_celsius = p.air_celsius = 25;
  HeatedPatch patch(p);
  EXPECT_EQ(patch.thermistor_mv(5000), 2500U);
  patch.break_it(HeaterBreak::open);
  EXPECT_EQ(patch.thermistor_mv(5000), 5000U);
  patch.break_it(HeaterBreak::shorted);
  EXPECT_EQ(patch.thermistor_mv(5000), 0U);
}

TEST(HeatedPatch, LeavesADetachedSensorInTheAir) {
  HeatedPatch patch;
  patch.break_it(HeaterBreak::detached);
  patch.advance(60, true);
  EXPECT_NEAR(patch.sensor_celsius(), patch.parameters.air_celsius, 0.1);
  EXPECT_GT(patch.pad_celsius(), 38);
}

TEST(HeaterFaultOption, NamesAHeaterWhatBreaksAndWhen) {
  const auto at_start = parse_heater_fault("1:short");
  EXPECT_EQ(at_start.heater, 1U);
  EXPECT_EQ(at_start.what, HeaterBreak::shorted);
  EXPECT_EQ(at_start.at_s, 0);
  const auto later = parse_heater_fault("0:runaway@2.5");
  EXPECT_EQ(later.heater, 0U);
  EXPECT_EQ(later.what, HeaterBreak::runaway);
  EXPECT_EQ(later.at_s, 2.5);
}

TEST(HeaterFaultOption, IsRefusedWithWhatToWriteInstead) {
  for (const char* const text : {"", "0", "0:", "0:melted", "open", "x:open", "0:open@", "0:open@-1", "0:open@nan",
                                 "0:open@1x", "0:openx", "0:open 1", "-1:open", "0:openopenopenopenopen"}) {
    EXPECT_THAT([text] { (void)parse_heater_fault(text); },
                ThrowsMessage<std::runtime_error>(HasSubstr("write HEATER:open")))
        << text;
  }
}

TEST(BoardWiring, HasNoPinTwice) {
  for (const BoardWiring& board : board_wirings()) {
    std::vector<std::pair<char, int>> pins{{'B', 5}, {'D', 0}, {'D', 1}};  // LED, serial line
    for (const BoardPin& pin : board.motors)
      pins.emplace_back(pin.port, pin.bit);
    for (const HeaterWiring& heater : board.heaters) {
      pins.emplace_back(heater.transistor.port, heater.transistor.bit);
      pins.emplace_back('C', heater.thermistor_input);
    }
    if (board.heater_supply) pins.emplace_back(board.heater_supply->port, board.heater_supply->bit);
    std::ranges::sort(pins);
    EXPECT_EQ(std::ranges::adjacent_find(pins), pins.end()) << board.name;
  }
  EXPECT_EQ(find_board("motors16"), &board_wirings().front());
  EXPECT_EQ(find_board("motors17"), nullptr);
}

}  // namespace
}  // namespace telehug
