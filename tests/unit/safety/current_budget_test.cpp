// SPDX-License-Identifier: Apache-2.0
#include "safety/current_budget.hpp"

#include <gmock/gmock.h>

#include <random>
#include <vector>

namespace telehug {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

std::vector<double> fitted(std::vector<Draw> draws, double supply_ma) {
  fit_current(draws, supply_ma);
  std::vector<double> powers;
  for (const Draw& draw : draws)
    powers.push_back(draw.power);
  return powers;
}

TEST(CurrentBudget, leaves_alone_what_the_supply_can_give) {
  EXPECT_THAT(fitted({{1, 0.3, 80}, {0.5, 0.3, 80}}, 120), ElementsAre(1, 0.5));
}

TEST(CurrentBudget, limits_nothing_if_the_supply_is_not_known) {
  EXPECT_THAT(fitted({{1, 0.3, 80}, {1, 0.3, 80}}, 0), ElementsAre(1, 1));
}

TEST(CurrentBudget, scales_all_alike) {
  EXPECT_THAT(fitted({{1, 0.1, 100}, {0.5, 0.1, 100}, {0.5, 0.1, 200}}, 125), ElementsAre(0.5, 0.25, 0.25));
}

TEST(CurrentBudget, leaves_out_the_weakest_of_those_that_would_not_turn_until_the_others_do) {
  // 270 mA are wanted: with 100 none would turn.
  EXPECT_THAT(fitted({{1, 0.5, 100}, {0.9, 0.5, 100}, {0.8, 0.5, 100}}, 100), ElementsAre(1, 0, 0))
      << "0.9 x 100 / 190 is less than 0.5";
  EXPECT_THAT(fitted({{1, 0.4, 100}, {0.9, 0.4, 100}, {0.8, 0.4, 100}}, 100),
              ElementsAre(DoubleNear(0.526, 0.001), DoubleNear(0.474, 0.001), 0));
}

TEST(CurrentBudget, leaves_out_the_last_of_equals_so_that_the_same_ones_stay_on) {
  EXPECT_THAT(fitted({{1, 0.6, 100}, {1, 0.6, 100}, {1, 0.6, 100}}, 150), ElementsAre(0.75, 0.75, 0));
}

TEST(CurrentBudget, turns_off_a_motor_that_the_supply_can_not_turn_at_all) {
  EXPECT_THAT(fitted({{1, 0.5, 100}}, 40), ElementsAre(0));
}

TEST(CurrentBudget, does_not_count_a_motor_whose_current_is_not_known) {
  EXPECT_THAT(fitted({{1, 0.3, 0}, {1, 0.3, 100}}, 50), ElementsAre(1, 0.5));
}

TEST(CurrentBudget, keeps_any_draws_within_the_supply_and_each_of_them_on_or_off) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 20000; ++round) {
    std::vector<Draw> draws(random() % 17);
    for (Draw& draw : draws) {
      draw.least_power = uniform(random);
      draw.power = random() % 4 == 0 ? 0 : draw.least_power + (1 - draw.least_power) * uniform(random);
      draw.full_ma = random() % 8 == 0 ? 0 : 120 * uniform(random);
    }
    const double supply_ma = 600 * uniform(random);
    const auto powers = fitted(draws, supply_ma);
    double total = 0;
    for (std::size_t i = 0; i < draws.size(); ++i) {
      total += powers[i] * draws[i].full_ma;
      ASSERT_LE(powers[i], draws[i].power);
      if (powers[i] > 0) {
        ASSERT_GE(powers[i], draws[i].least_power);
      }
    }
    ASSERT_LE(total, supply_ma + 1e-9);
  }
}

}  // namespace
}  // namespace telehug
