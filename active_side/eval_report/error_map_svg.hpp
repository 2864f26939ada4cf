// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eval_report/report.hpp"

namespace telehug {

// A field of the screen and what the touches that belong there have in common.
struct MapCell {
  std::size_t touches = 0;
  std::optional<double> value;
};

struct ErrorMap {
  static constexpr std::size_t columns = 8;
  static constexpr std::size_t rows = 6;
  std::vector<MapCell> cells = std::vector<MapCell>(columns * rows);  // row by row from the top left
};

// The mean of what `value` says of the touches in each field; touches of which it says nothing don't count.
[[nodiscard]] ErrorMap map_errors(const std::vector<ReportedTouch>& touches,
                                  const std::function<std::optional<double>(const ScoredTouch&)>& value);

// Each field with its value (`decimals`), how many touches it stands for, and a colour; the legend goes from 0 to
// `high`, above which colours stay the same.
[[nodiscard]] std::string error_map_svg(const std::string& title, const ErrorMap& map, double high, int decimals);

}  // namespace telehug
