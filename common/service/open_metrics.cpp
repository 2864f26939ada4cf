// SPDX-License-Identifier: Apache-2.0
#include "service/open_metrics.hpp"

#include <fmt/core.h>

#include <cmath>

namespace telehug {
namespace {

std::string_view name_of(MetricType type) {
  constexpr std::string_view names[] = {"counter", "gauge", "histogram", "info", "stateset"};
  return names[static_cast<std::size_t>(type)];
}

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\n') {
      safe += "\\n";
      continue;
    }
    if (c == '\\' || c == '"') safe += '\\';
    safe += c;
  }
  return safe;
}

// Whole up to 2^53, as counts are, without an exponent.
std::string number(double value) {
  if (std::trunc(value) == value && std::abs(value) < 9007199254740992.0) return fmt::format("{:.0f}", value);
  return fmt::format("{}", value);
}

}  // namespace

void OpenMetricsText::begin(const MetricFamily& family) {
  family_ = family;
  headed_ = false;
}

void OpenMetricsText::line(std::string_view suffix, const MetricLabels& labels, std::string_view value) {
  if (!headed_) {
    text_ += fmt::format("# TYPE {} {}\n", family_.name, name_of(family_.type));
    if (!family_.unit.empty()) text_ += fmt::format("# UNIT {} {}\n", family_.name, family_.unit);
    text_ += fmt::format("# HELP {} {}\n", family_.name, escaped(family_.help));
    headed_ = true;
  }
  text_ += fmt::format("{}{}", family_.name, suffix);
  char before = '{';
  for (const auto& [label, content] : labels) {
    text_ += fmt::format("{}{}=\"{}\"", before, label, escaped(content));
    before = ',';
  }
  text_ += fmt::format("{} {}\n", labels.empty() ? "" : "}", value);
}

void OpenMetricsText::sample(const MetricLabels& labels, double value) {
  if (!std::isfinite(value)) return;
  const bool counts = family_.type == MetricType::counter;
  const bool informs = family_.type == MetricType::info;
  line(counts ? "_total" : informs ? "_info" : "", labels, number(value));
}

void OpenMetricsText::sample(const MetricLabels& labels, const LatencyHistogram& histogram) {
  const LatencyHistogram::Cumulative counts = histogram.cumulative();
  MetricLabels bucket = labels;
  bucket.emplace_back("le", "");
  for (const auto& [up_to_ns, count] : counts.steps) {
    bucket.back().second = fmt::format("{:.9f}", static_cast<double>(up_to_ns) * 1e-9);
    line("_bucket", bucket, std::to_string(count));
  }
  bucket.back().second = "+Inf";
  line("_bucket", bucket, std::to_string(counts.count));
  line("_count", labels, std::to_string(counts.count));
  line("_sum", labels, number(static_cast<double>(counts.sum_ns) * 1e-9));
}

std::string OpenMetricsText::end() && {
  text_ += "# EOF\n";
  return std::move(text_);
}

}  // namespace telehug
