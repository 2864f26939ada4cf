// SPDX-License-Identifier: Apache-2.0
#include "eval_report/linear_scale.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {

LinearScale::LinearScale(double low_value, double high_value, double low_px, double high_px)
    : low_value_(low_value),
      high_value_(high_value),
      low_px_(low_px),
      px_per_value_((high_px - low_px) / (high_value - low_value)) {}

double LinearScale::clamped_px(double value) const noexcept {
  return px(std::clamp(value, low_value_, high_value_));
}

std::vector<double> LinearScale::ticks(int wanted) const {
  const double rough = (high_value_ - low_value_) / std::max(1, wanted);
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double leading = rough / power;
  const double step = power * (leading < 1.5 ? 1 : leading < 3.5 ? 2 : leading < 7.5 ? 5 : 10);
  std::vector<double> values;
  const double slack = 1e-9 * step;
  for (double i = std::ceil((low_value_ - slack) / step); i * step <= high_value_ + slack; ++i)
    values.push_back(i * step + 0.0);  // never -0
  return values;
}

}  // namespace telehug
