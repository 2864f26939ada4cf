// SPDX-License-Identifier: Apache-2.0
//
// What both daemons tell a scraper (OpenMetrics), as one table: every counter of a status has its place here, beside
// what else of a status is a number. No names of people, pairs or devices are among them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "service/open_metrics.hpp"

namespace telehug {

// One counter of a status ("counters"), and what its family's label says then.
struct CounterSource {
  std::string_view counter;
  std::string_view label_value;
};

struct MetricRow {
  MetricFamily family;
  std::string_view label;                                                       // of a counter; empty: it has none
  std::vector<CounterSource> counters = {};                                     // of a counter
  void (*tell)(const nlohmann::json& status, OpenMetricsText& text) = nullptr;  // of a gauge, info or stateset
};

[[nodiscard]] const std::vector<MetricRow>& metric_table();

// `status` is a daemon's answer to "status". What it lacks, as the other side's things, is left out.
[[nodiscard]] std::string open_metrics(const nlohmann::json& status, const MetricsRegistry& metrics);

}  // namespace telehug
