// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace telehug {

// All of these want at least one value.
[[nodiscard]] double mean(const std::vector<double>& values);
[[nodiscard]] double standard_deviation(const std::vector<double>& values);  // of a sample; 0 for a single value

// The smallest value that at least this share (0 to 1) does not exceed.
[[nodiscard]] double quantile(std::vector<double> values, double share);

[[nodiscard]] inline double p95(const std::vector<double>& values) {
  return quantile(values, 0.95);
}

// Tukey's: whiskers reach to the outermost values within 1.5 times the box' length from the box; what lies beyond is an
// outlier.
struct BoxPlot {
  double low_whisker = 0;
  double first_quartile = 0;
  double median = 0;
  double third_quartile = 0;
  double high_whisker = 0;
  std::vector<double> outliers;  // rising
};

// Quartiles between two values are interpolated.
[[nodiscard]] BoxPlot box_plot(std::vector<double> values);

}  // namespace telehug
