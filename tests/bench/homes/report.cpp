// SPDX-License-Identifier: Apache-2.0
#include "bench/homes/report.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace telehug {
namespace {

constexpr double frame_ms = 1000.0 / 120;
constexpr double most_above_udp = 1.3;
constexpr double most_of_mqtt = 0.5;  // what "well ahead" means here
constexpr double most_one_way_ms = 0.15;
constexpr double most_sender_cpu = 0.02;

std::string percentiles(const std::vector<double>& values) {
  std::string text;
  for (const double part : {0.5, 0.95, 0.99, 0.999, 1.0})
    text += fmt::format(" {:>9.3f}", quantile(values, part));
  return text;
}

std::string heading(const char* what, const char* more) {
  return fmt::format("{:<44} {:<8} {:>9} {:>9} {:>9} {:>9} {:>9}{}\n", what, "way", "p50", "p95", "p99", "p99.9", "max",
                     more);
}

const Row& row_of(const std::vector<Row>& rows, const std::string& network, Way way) {
  for (const Row& row : rows)
    if (row.network == network && row.way == way) return row;
  throw std::logic_error("no row of " + network);
}

std::string goal(const char* what, double value, double limit, const char* unit) {
  return fmt::format("{:<72} {:>9.3f} of {:>9.3f} {:<3} {}\n", what, value, limit, unit,
                     value <= limit ? "reached" : "not reached");
}

}  // namespace

std::string tables_text(const std::vector<Row>& rows) {
  std::string ages = heading("age of the newest state known, ms", "");
  std::string one_ways = heading("one way of single packets, ms", "    states lost  downs, ups lost");
  for (const Row& row : rows) {
    const LinkFigures& figures = row.figures;
    const std::string name = fmt::format("{:<44} {:<8}", row.network, name_of(row.way));
    ages += fmt::format("{}{}\n", name, percentiles(figures.age_ms));
    one_ways += fmt::format("{}{} {:>14} {:>15}\n", name, percentiles(figures.one_way_ms),
                            fmt::format("{} of {}", figures.states_lost, figures.states),
                            fmt::format("{} of {}", figures.transitions_lost, figures.transitions));
  }
  return ages + "\n" + one_ways;
}

std::string cpu_text(const std::vector<CpuRow>& rows, int rate_hz) {
  std::string text =
      fmt::format("{:<44} {:<8} {:>9} {:>22}\n", fmt::format("CPU at {} Hz on loopback, % of a core", rate_hz), "way",
                  "sender", "receiver (and broker)");
  for (const CpuRow& row : rows)
    text +=
        fmt::format("{:<44} {:<8} {:>9.2f} {:>22.2f}\n", "", name_of(row.way), 100 * row.sender, 100 * row.receiver);
  return text;
}

std::string goals_text(const std::vector<Row>& rows, const std::vector<CpuRow>& cpu, const std::string& loopback,
                       const std::string& lossy) {
  const double udp_age = quantile(row_of(rows, lossy, Way::udp).figures.age_ms, 0.5);
  const double age = quantile(row_of(rows, lossy, Way::secured).figures.age_ms, 0.99);
  const double mqtt_age = quantile(row_of(rows, lossy, Way::mqtt).figures.age_ms, 0.99);
  const double one_way = quantile(row_of(rows, loopback, Way::secured).figures.one_way_ms, 0.5);
  double sender = 0;
  for (const CpuRow& row : cpu)
    if (row.way == Way::secured) sender = row.sender;
  return goal("through loss: p99 age within 1.3 x raw UDP's p50 and a frame", age, most_above_udp * udp_age + frame_ms,
              "ms") +
         goal("through loss: p99 age at most half of MQTT's", age, most_of_mqtt * mqtt_age, "ms") +
         goal("loopback: p50 of one way", one_way, most_one_way_ms, "ms") +
         goal("CPU of the secured sender", 100 * sender, 100 * most_sender_cpu, "%");
}

nlohmann::json figures_json(const std::vector<Row>& rows, const std::vector<CpuRow>& cpu) {
  nlohmann::json json;
  const auto add = [&](const std::string& name, const std::vector<double>& values) {
    json[name] = {{"p50", quantile(values, 0.5)},     {"p95", quantile(values, 0.95)}, {"p99", quantile(values, 0.99)},
                  {"p99.9", quantile(values, 0.999)}, {"max", quantile(values, 1)},    {"unit", "ms"}};
  };
  for (const Row& row : rows) {
    const std::string name = fmt::format("homes.{}.{}", row.network, name_of(row.way));
    add(name + ".age", row.figures.age_ms);
    add(name + ".one_way", row.figures.one_way_ms);
    json[name + ".lost"] = {{"states", row.figures.states}, {"states_lost", row.figures.states_lost}};
  }
  for (const CpuRow& row : cpu)
    json[fmt::format("homes.cpu.{}", name_of(row.way))] = {{"p50", 100 * row.sender}, {"unit", "% of a core"}};
  return json;
}

}  // namespace telehug
