// SPDX-License-Identifier: Apache-2.0
#include "gpio/jacket_situation.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

constexpr JacketSituation ready{.armed = true, .stopped = false, .sender = true, .touched = false, .problem = false};

TEST(TheSupply, IsOnOnlyWhileSomebodyCanBeFelt) {
  EXPECT_TRUE(supply_wanted(ready));
  for (int bits = 0; bits < 32; ++bits) {
    const JacketSituation now{.armed = (bits & 1) != 0,
                              .stopped = (bits & 2) != 0,
                              .sender = (bits & 4) != 0,
                              .touched = (bits & 8) != 0,
                              .problem = (bits & 16) != 0};
    EXPECT_EQ(supply_wanted(now), (bits | 8) == (1 | 4 | 8)) << bits;
  }
}

// What the light does in 2 s, looked at every 100 ms.
std::string shown(const JacketSituation& now) {
  std::string lit;
  for (Duration time = 50ms; time < 2s; time += 100ms)
    lit += light_on(light_pattern(now), time) ? '#' : '.';
  return lit;
}

TEST(TheLight, IsSteadyWhenAllIsReady) {
  EXPECT_EQ(shown(ready), "####################");
}

TEST(TheLight, FlashesSlowlyWhileItWaitsForTheOtherSide) {
  JacketSituation waiting = ready;
  waiting.sender = false;
  EXPECT_EQ(shown(waiting), "##..................");
}

TEST(TheLight, FlashesTwiceWhileTouched) {
  JacketSituation touched = ready;
  touched.touched = true;
  EXPECT_EQ(shown(touched), "#.#.......#.#.......");
}

TEST(TheLight, BlinksFastWhenStoppedOrSomethingIsWrong) {
  for (bool JacketSituation::*what : {&JacketSituation::stopped, &JacketSituation::problem}) {
    JacketSituation now = ready;
    now.touched = true;
    now.*what = true;
    EXPECT_EQ(shown(now), "#.#.#.#.#.#.#.#.#.#.");
  }
  JacketSituation no_jacket = ready;
  no_jacket.armed = false;
  EXPECT_EQ(shown(no_jacket), "#.#.#.#.#.#.#.#.#.#.");
}

}  // namespace
}  // namespace telehug
