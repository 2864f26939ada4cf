// SPDX-License-Identifier: Apache-2.0
//
// Metrics as text that scrapers read: OpenMetrics 1.0 (github.com/prometheus/OpenMetrics,
// specification/OpenMetrics.md).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "service/metrics.hpp"

namespace telehug {

inline constexpr std::string_view open_metrics_type = "application/openmetrics-text; version=1.0.0; charset=utf-8";

enum class MetricType { counter, gauge, histogram, info, stateset };

struct MetricFamily {
  std::string_view name;  // without "_total" and its like; ends with the unit, if there is one
  MetricType type = MetricType::gauge;
  std::string_view unit;  // "seconds"; empty: none
  std::string_view help;
};

using MetricLabels = std::vector<std::pair<std::string_view, std::string>>;

class OpenMetricsText {
 public:
  // All samples of a family follow each other. One without samples is left out.
  void begin(const MetricFamily& family);
  // Of a counter, gauge, info (always 1) or stateset (1 or 0). What is not finite is no sample.
  void sample(const MetricLabels& labels, double value);
  // Of a histogram.
  void sample(const MetricLabels& labels, const LatencyHistogram& histogram);

  // The whole text, after which there is none.
  [[nodiscard]] std::string end() &&;

 private:
  void line(std::string_view suffix, const MetricLabels& labels, std::string_view value);

  MetricFamily family_;
  bool headed_ = false;
  std::string text_;
};

}  // namespace telehug
