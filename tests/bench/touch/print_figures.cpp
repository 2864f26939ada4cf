// SPDX-License-Identifier: Apache-2.0
#include "bench/touch/print_figures.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace telehug {

void print_and_write(const Figures& figures, const std::string& json_file) {
  nlohmann::json json;
  fmt::print("{:<56}{:>10}{:>10}{:>10}\n", "", "p10", "p50", "p99");
  for (const Figure& figure : figures) {
    const double p10 = figure.percentile(0.1);
    const double p50 = figure.percentile(0.5);
    const double p99 = figure.percentile(0.99);
    fmt::print("{:<56}{:>10.4f}{:>10.4f}{:>10.4f} {}\n", figure.name, p10, p50, p99, figure.unit);
    json[figure.name] = {{"p50", p50}, {"p99", p99}, {"unit", figure.unit}};
  }
  if (json_file.empty()) return;
  std::ofstream out(json_file);
  out << json.dump(2) << '\n';
  out.close();
  if (!out) throw std::runtime_error("can't write " + json_file);
}

}  // namespace telehug
