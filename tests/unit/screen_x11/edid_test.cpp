// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/edid.hpp"

#include <gmock/gmock.h>

#include "doubles/monitor_edid.hpp"

namespace telehug {
namespace {

TEST(AnEdid, TellsTheSizeToAMillimetre) {
  EXPECT_EQ(monitor_size_in_edid(monitor_edid({60, 34}, {597, 336})), (MonitorMm{597, 336}));
}

TEST(AnEdid, TellsWholeCentimetresWhereItsTimingTellsTheAspect) {
  EXPECT_EQ(monitor_size_in_edid(monitor_edid({60, 34}, {16, 9})), (MonitorMm{600, 340}));
  EXPECT_EQ(monitor_size_in_edid(monitor_edid({60, 34}, {160, 90})), (MonitorMm{600, 340}));
  EXPECT_EQ(monitor_size_in_edid(monitor_edid({60, 34}, {})), (MonitorMm{600, 340})) << "it has no timing";
}

TEST(AnEdid, TellsNoSizeThatNoMonitorHas) {
  EXPECT_FALSE(monitor_size_in_edid(monitor_edid({0, 0}, {597, 336}))) << "a projector";
  EXPECT_FALSE(monitor_size_in_edid(monitor_edid({79, 0}, {}))) << "an aspect (EDID 1.4)";
  EXPECT_FALSE(monitor_size_in_edid(monitor_edid({16, 9}, {160, 90}))) << "an aspect";
}

TEST(AnEdid, IsNotBelievedWhenItIsDamagedOrCutOffOrNone) {
  const auto whole = monitor_edid({60, 34}, {597, 336});
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(monitor_size_in_edid(std::span(whole).first(length))) << length;
  for (std::size_t byte = 0; byte < whole.size(); ++byte) {
    auto damaged = whole;
    damaged[byte] ^= 0x10;
    EXPECT_FALSE(monitor_size_in_edid(damaged)) << byte;
  }
}

TEST(AnEdid, MayGoOnWithFurtherBlocks) {
  auto longer = monitor_edid({60, 34}, {597, 336});
  longer.resize(256, 0xAB);
  EXPECT_EQ(monitor_size_in_edid(longer), (MonitorMm{597, 336}));
}

}  // namespace
}  // namespace telehug
