// SPDX-License-Identifier: Apache-2.0
#include "finger/finger_edges.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {
namespace {

float mean(std::span<const float> red, int first, int count) {
  float sum = 0;
  for (int i = first; i < first + count; ++i)
    sum += red[static_cast<std::size_t>(i)];
  return sum / static_cast<float>(count);
}

// The column at which the values left and right of it differ most.
int refine(std::span<const float> red, int coarse) {
  constexpr int n = FingerEdgeFinder::refined_group_columns;
  constexpr int reach = FingerEdgeFinder::refined_within_columns / 2;
  const int last = std::min(coarse + reach, static_cast<int>(red.size()) - n);
  int best = coarse;
  float best_step = -1;
  for (int column = std::max(coarse - reach, n); column <= last; ++column) {
    const float step = std::abs(mean(red, column, n) - mean(red, column - n, n));
    if (step > best_step) {
      best_step = step;
      best = column;
    }
  }
  return best;
}

}  // namespace

FingerEdgeFinder::FingerEdgeFinder(int columns, double least_step)
    : least_step_(least_step), step_(static_cast<std::size_t>(std::max(columns, 0) / group_columns), 0.0F) {}

std::optional<FingerColumns> FingerEdgeFinder::find(std::span<const float> red) {
  const int groups = std::min(static_cast<int>(step_.size()), static_cast<int>(red.size()) / group_columns);
  if (groups < 2) return std::nullopt;
  float before = mean(red, 0, group_columns);
  step_[0] = 0;
  for (int group = 1; group < groups; ++group) {
    const float here = mean(red, group * group_columns, group_columns);
    step_[static_cast<std::size_t>(group)] = std::abs(here - before);
    before = here;
  }

  const auto largest = [&](int excluded) {
    int best = 0;
    for (int group = 1; group < groups; ++group) {
      if (excluded > 0 && std::abs(group - excluded) * group_columns < least_width_px) continue;
      if (best == 0 || step_[static_cast<std::size_t>(group)] > step_[static_cast<std::size_t>(best)]) best = group;
    }
    return best;
  };
  const int strongest = largest(0);
  const int second = largest(strongest);
  if (second == 0 || step_[static_cast<std::size_t>(second)] < least_step_) return std::nullopt;

  const int a = refine(red, strongest * group_columns);
  const int b = refine(red, second * group_columns);
  const FingerColumns columns{std::min(a, b), std::max(a, b)};
  if (columns.width() < least_width_px) return std::nullopt;
  return columns;
}

}  // namespace telehug
