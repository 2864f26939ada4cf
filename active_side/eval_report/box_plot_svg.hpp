// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace telehug {

struct BoxPlotRow {
  std::string name;
  std::vector<double> values;
};

// Lying box plots below each other on one axis from -reach to reach: median, quartiles, whiskers and outliers; how many
// lie beyond stands at the axis' end. Rows without values are left empty.
[[nodiscard]] std::string box_plots_svg(const std::string& title, const std::vector<BoxPlotRow>& rows, double reach);

}  // namespace telehug
