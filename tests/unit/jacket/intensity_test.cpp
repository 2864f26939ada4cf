// SPDX-License-Identifier: Apache-2.0
#include "safety/intensity.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <set>

namespace telehug {
namespace {

// What the microcontroller makes of an intensity (passive_side/firmware/motors.cpp): the nearest of 31 steps.
int step_at_pin(std::uint8_t intensity) {
  return (intensity * 31 + 127) / 255;
}

TEST(IntensityScale, reaches_every_step_of_the_microcontroller_between_the_limits_and_no_other) {
  for (int least = 1; least <= 31; ++least) {
    for (int most = least; most <= 31; ++most) {
      const IntensityScale scale(least / 31.0, most / 31.0);
      std::set<int> reached;
      for (int i = 1; i <= 1000; ++i)
        reached.insert(step_at_pin(scale.intensity(i / 1000.0)));
      EXPECT_EQ(*reached.begin(), least);
      EXPECT_EQ(*reached.rbegin(), most);
      EXPECT_EQ(reached.size(), static_cast<std::size_t>(most - least + 1));
    }
  }
}

TEST(IntensityScale, rounds_limits_inwards_for_any_limits) {
  for (double min = 0; min <= 1; min += 0.013) {
    for (double max = min; max <= 1; max += 0.017) {
      const IntensityScale scale(min, max);
      for (double strength = 0.001; strength < 1.5; strength += 0.1) {
        const int step = step_at_pin(scale.intensity(strength));
        if (step == 0) continue;
        EXPECT_GE(step / 31.0, min - 1e-6);
        EXPECT_LE(step / 31.0, max + 1e-6);
      }
    }
  }
}

TEST(IntensityScale, is_off_for_no_strength_no_number_and_limits_without_a_step_between_them) {
  const IntensityScale scale(0.2, 0.9);
  EXPECT_EQ(scale.intensity(0), 0);
  EXPECT_EQ(scale.intensity(-1), 0);
  EXPECT_EQ(scale.intensity(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(scale.intensity(std::numeric_limits<double>::infinity()), 0);
  EXPECT_EQ(IntensityScale(0.5, 0.49).intensity(1), 0);
  EXPECT_EQ(IntensityScale(0, 0).intensity(1), 0);
  EXPECT_EQ(IntensityScale(0.501, 0.502).intensity(1), 0);
}

TEST(IntensityScale, never_weakens_when_strength_grows) {
  const IntensityScale scale(0.35, 0.8);
  for (double strength = 0; strength < 1; strength += 0.001) {
    EXPECT_LE(scale.intensity(strength), scale.intensity(strength + 0.001));
  }
}

}  // namespace
}  // namespace telehug
