// SPDX-License-Identifier: Apache-2.0
#include "body_map/one_euro_filter.hpp"

#include <gtest/gtest.h>

#include <random>

namespace telehug {
namespace {

constexpr double look_s = 0.125;

TEST(OneEuroFilter, KeepsAConstant) {
  OneEuroFilter filter;
  filter.reset(3);
  for (int i = 0; i < 10; ++i)
    EXPECT_DOUBLE_EQ(filter.update(3, look_s), 3);
}

// At rest it is a low pass of the first order: gain T / (T + 1 / (2 pi f)) a step.
TEST(OneEuroFilter, FollowsAStepWithoutSpeedTermAsALowPass) {
  OneEuroFilter filter({.min_cutoff_hz = 0.3, .beta = 0, .speed_cutoff_hz = 1});
  filter.reset(0);
  const double gain = look_s / (look_s + 1 / (2 * std::numbers::pi * 0.3));
  EXPECT_NEAR(filter.update(1, look_s), gain, 1e-12);
  EXPECT_NEAR(filter.update(1, look_s), gain + gain * (1 - gain), 1e-12);
}

TEST(OneEuroFilter, LagsLessWhereItMovesFaster) {
  const auto lag = [](double speed) {
    OneEuroFilter filter;
    filter.reset(0);
    double value = 0;
    for (int i = 0; i < 40; ++i)
      filter.update(value += speed * look_s, look_s);
    return (value - filter.value()) / speed;
  };
  EXPECT_LT(lag(1), lag(0.1));
  EXPECT_LT(lag(0.1), lag(0.01));
}

TEST(OneEuroFilter, CalmsNoise) {
  std::mt19937 random{3};
  std::normal_distribution<double> noise(0, 0.005);
  OneEuroFilter filter;
  filter.reset(0);
  double sum = 0;
  for (int i = 0; i < 800; ++i) {
    const double value = filter.update(noise(random), look_s);
    sum += value * value;
  }
  EXPECT_LT(std::sqrt(sum / 800), 0.0025);
}

TEST(OneEuroFilter, IsTheSameInOtherUnits) {
  OneEuroFilter metres;
  OneEuroFilter heights;
  metres.reset(0);
  heights.reset(0);
  for (int i = 1; i < 20; ++i)
    EXPECT_NEAR(metres.update(i * i * 7.0, look_s, 7), 7 * heights.update(i * i, look_s), 1e-9);
}

}  // namespace
}  // namespace telehug
