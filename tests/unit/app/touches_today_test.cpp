// SPDX-License-Identifier: Apache-2.0
#include "touches_today.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

using Json = nlohmann::json;
using std::chrono::sys_days;
using std::chrono::sys_seconds;
using namespace std::chrono_literals;

constexpr sys_seconds midnight = sys_days{std::chrono::year{2026} / 6 / 1};

TEST(TouchesOfToday, AreCountedSinceTheStartAndThenFromMidnightOn) {
  setenv("TZ", "UTC0", 1);
  tzset();
  TouchesToday today(midnight + 14h + 5min);
  EXPECT_EQ(today.json(midnight + 14h + 6min), Json({{"touches", 0}, {"since", "14:05"}}));
  today.add(midnight + 15h);
  today.add(midnight + 24h - 1s);
  EXPECT_EQ(today.json(midnight + 24h - 1s), Json({{"touches", 2}, {"since", "14:05"}}));
  EXPECT_EQ(today.json(midnight + 24h), Json({{"touches", 0}}));
  today.add(midnight + 30h);
  EXPECT_EQ(today.json(midnight + 30h), Json({{"touches", 1}}));
  today.add(midnight + 48h);
  EXPECT_EQ(today.json(midnight + 48h), Json({{"touches", 1}})) << "it may begin with a touch";
}

TEST(TouchesOfToday, FollowTheLocalDay) {
  setenv("TZ", "CET-1", 1);
  tzset();
  TouchesToday today(midnight + 22h);
  today.add(midnight + 23h - 1s);
  EXPECT_EQ(today.json(midnight + 23h), Json({{"touches", 0}})) << "midnight there";
  setenv("TZ", "UTC0", 1);
  tzset();
}

}  // namespace
}  // namespace telehug
