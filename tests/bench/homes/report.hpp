// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/homes/exchange.hpp"

namespace telehug {

struct Row {
  std::string network;
  Way way = Way::secured;
  LinkFigures figures;  // of all rounds
};

struct CpuRow {
  Way way = Way::secured;
  double sender = 0;
  double receiver = 0;
};

// Two tables: how old the newest state is, and how long single packets are on their way.
[[nodiscard]] std::string tables_text(const std::vector<Row>& rows);
[[nodiscard]] std::string cpu_text(const std::vector<CpuRow>& rows, int rate_hz);
// For each goal whether it is reached, with both numbers.
[[nodiscard]] std::string goals_text(const std::vector<Row>& rows, const std::vector<CpuRow>& cpu,
                                     const std::string& loopback, const std::string& lossy);
[[nodiscard]] nlohmann::json figures_json(const std::vector<Row>& rows, const std::vector<CpuRow>& cpu);

}  // namespace telehug
