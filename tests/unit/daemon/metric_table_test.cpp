// SPDX-License-Identifier: Apache-2.0
#include "daemon/metric_table.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

// What a family's samples may be called.
std::set<std::string> sample_names() {
  std::set<std::string> names;
  for (const MetricRow& row : metric_table()) {
    const std::string name(row.family.name);
    switch (row.family.type) {
      case MetricType::counter:
        names.insert(name + "_total");
        break;
      case MetricType::info:
        names.insert(name + "_info");
        break;
      case MetricType::histogram:
        names.insert({name + "_bucket", name + "_sum", name + "_count"});
        break;
      case MetricType::gauge:
      case MetricType::stateset:
        names.insert(name);
        break;
    }
  }
  return names;
}

TEST(TheTableOfMetrics, NamesEachFamilyAndCounterOnceAndByTheConventions) {
  std::set<std::string_view> families;
  std::set<std::string_view> counters;
  for (const MetricRow& row : metric_table()) {
    const std::string name(row.family.name);
    EXPECT_TRUE(families.insert(row.family.name).second) << name;
    EXPECT_TRUE(std::regex_match(name, std::regex("telehug(_[a-z]+)+"))) << name;
    EXPECT_TRUE(row.family.unit.empty() || name.ends_with("_" + std::string(row.family.unit))) << name;
    EXPECT_TRUE(row.family.help.ends_with('.')) << name;
    EXPECT_EQ(row.family.type == MetricType::counter, !row.counters.empty()) << name;
    std::set<std::string_view> values;
    for (const CounterSource& source : row.counters) {
      EXPECT_TRUE(counters.insert(source.counter).second) << source.counter;
      EXPECT_TRUE(values.insert(source.label_value).second) << source.counter;
      EXPECT_EQ(source.label_value.empty(), row.label.empty()) << source.counter;
    }
  }
}

TEST(TheTableOfMetrics, HasEveryMetricOfTheDashboard) {
  std::ifstream file(TELEHUG_SOURCE "/deploy/grafana/telehug.json");
  const Json dashboard = Json::parse(file);
  const std::set<std::string> known = sample_names();
  const std::regex metric("telehug_[a-z_]+");
  std::size_t found = 0;
  for (const Json& panel : dashboard.at("panels")) {
    for (const Json& target : panel.at("targets")) {
      const std::string expression = target.at("expr");
      for (std::sregex_iterator at(expression.begin(), expression.end(), metric), end; at != end; ++at, ++found)
        EXPECT_TRUE(known.contains(at->str())) << panel.at("title") << ": " << at->str();
    }
  }
  EXPECT_GT(found, 30U);
}

TEST(TheTableOfMetrics, TellsWhatAStatusHasAndNothingOfTheOtherSide) {
  const Json status = {{"side", "passive"},
                       {"version", "1.2"},
                       {"uptime_s", 3.5},
                       {"state", "paused"},
                       {"problems", Json::array({1, 2})},
                       {"peer", {{"connected", true}, {"round_trip_ms", 4}}},
                       {"pair", {{"name", "Grandma"}}},
                       {"jacket", {{"state", "armed"}, {"running", {3}}, {"supply_v", 4.9}}},
                       {"duty", Json::array({{{"id", 3}, {"used", 0.25}}})},
                       {"heaters", Json::array({{{"id", 17}, {"celsius", 36.5}, {"set_point_celsius", 38}}})},
                       {"counters", {{"events_stale", 7}, {"off_stop", 2}}}};
  MetricsRegistry metrics;
  metrics.latency("drive").record(1ms);
  const std::string text = open_metrics(status, metrics);
  for (const char* line :
       {"telehug_build_info{side=\"passive\",version=\"1.2\"} 1\n", "telehug_uptime_seconds 3.5\n",
        "telehug_state{telehug_state=\"paused\"} 1\n", "telehug_state{telehug_state=\"ok\"} 0\n",
        "telehug_problems 2\n", "telehug_peers_connected 1\n", "telehug_peer_round_trip_seconds 0.004\n",
        "telehug_jacket_state{telehug_jacket_state=\"armed\"} 1\n", "telehug_jacket_supply_volts 4.9\n",
        "telehug_actuators_running 1\n", "telehug_actuator_duty_ratio{actuator=\"3\"} 0.25\n",
        "telehug_heater_temperature_celsius{actuator=\"17\"} 36.5\n",
        "telehug_heater_set_point_celsius{actuator=\"17\"} 38\n", "telehug_events_dropped_total{cause=\"stale\"} 7\n",
        "telehug_actuators_off_total{cause=\"stop\"} 2\n", "telehug_stage_duration_seconds_count{stage=\"drive\"} 1\n"})
    EXPECT_THAT(text, HasSubstr(std::string("\n") + line));
  EXPECT_THAT(text, Not(HasSubstr("camera")));
  EXPECT_THAT(text, Not(HasSubstr("Grandma")));
}

}  // namespace
}  // namespace telehug
