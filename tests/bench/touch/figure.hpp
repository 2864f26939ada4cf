// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "common/clock.hpp"

namespace telehug {

inline constexpr int bench_rounds = 1000;
inline constexpr int bench_warm_up_rounds = 50;

struct Figure {
  std::string name;
  std::string unit;
  std::vector<double> samples = {};

  [[nodiscard]] double percentile(double part) const {
    std::vector<double> sorted = samples;
    std::sort(sorted.begin(), sorted.end());
    return sorted.at(static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1)));
  }
};

using Figures = std::vector<Figure>;

class Stopwatch {
 public:
  // Milliseconds since the last call.
  double lap_ms() {
    const Timestamp now = std::chrono::steady_clock::now();
    const double ms = to_ms(now - start_);
    start_ = std::chrono::steady_clock::now();
    return ms;
  }

 private:
  Timestamp start_ = std::chrono::steady_clock::now();
};

}  // namespace telehug
