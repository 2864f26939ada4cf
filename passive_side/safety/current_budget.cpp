// SPDX-License-Identifier: Apache-2.0
#include "safety/current_budget.hpp"

namespace telehug {
namespace {

double total_ma(std::span<const Draw> draws) {
  double total = 0;
  for (const Draw& draw : draws)
    total += draw.power * draw.full_ma;
  return total;
}

Draw* weakest_that_would_not_turn(std::span<Draw> draws, double scale) {
  Draw* weakest = nullptr;
  for (Draw& draw : draws) {
    if (draw.power <= 0 || draw.full_ma <= 0 || draw.power * scale >= draw.least_power) continue;
    if (weakest == nullptr || draw.power <= weakest->power) weakest = &draw;
  }
  return weakest;
}

}  // namespace

void fit_current(std::span<Draw> draws, double supply_ma) noexcept {
  if (supply_ma <= 0) return;
  for (std::size_t tries = 0; tries <= draws.size(); ++tries) {
    const double total = total_ma(draws);
    if (total <= supply_ma) return;
    const double scale = supply_ma / total;
    if (Draw* weakest = weakest_that_would_not_turn(draws, scale)) {
      weakest->power = 0;
      continue;
    }
    for (Draw& draw : draws)
      if (draw.full_ma > 0) draw.power *= scale;
    return;
  }
}

}  // namespace telehug
