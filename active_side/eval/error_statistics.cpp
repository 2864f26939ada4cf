// SPDX-License-Identifier: Apache-2.0
#include "eval/error_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace telehug {
namespace {

double interpolated(const std::vector<double>& rising, double share) {
  const double rank = share * static_cast<double>(rising.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, rising.size() - 1);
  return std::lerp(rising[below], rising[above], rank - static_cast<double>(below));
}

}  // namespace

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_deviation(const std::vector<double>& values) {
  if (values.size() < 2) return 0;
  const double middle = mean(values);
  double squares = 0;
  for (const double value : values)
    squares += (value - middle) * (value - middle);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double quantile(std::vector<double> values, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

BoxPlot box_plot(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  BoxPlot box;
  box.first_quartile = interpolated(values, 0.25);
  box.median = interpolated(values, 0.5);
  box.third_quartile = interpolated(values, 0.75);
  const double reach = 1.5 * (box.third_quartile - box.first_quartile);
  box.low_whisker = box.first_quartile;
  box.high_whisker = box.third_quartile;
  for (const double value : values) {
    if (value < box.first_quartile - reach || value > box.third_quartile + reach) {
      box.outliers.push_back(value);
    } else {
      box.low_whisker = std::min(box.low_whisker, value);
      box.high_whisker = std::max(box.high_whisker, value);
    }
  }
  return box;
}

}  // namespace telehug
