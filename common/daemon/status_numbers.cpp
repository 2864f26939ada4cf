// SPDX-License-Identifier: Apache-2.0
#include "daemon/status_numbers.hpp"

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

namespace telehug::status_numbers {
namespace {

using Json = nlohmann::json;

void tell_number(const Json& status, OpenMetricsText& text, const char* pointer, double factor = 1) {
  const Json::json_pointer place(pointer);
  if (!status.contains(place)) return;
  const Json& value = status.at(place);
  if (value.is_boolean()) {
    text.sample({}, value.get<bool>() ? 1 : 0);
  } else if (value.is_number()) {
    text.sample({}, value.get<double>() * factor);
  }
}

void tell_size(const Json& status, OpenMetricsText& text, const char* pointer) {
  const Json::json_pointer place(pointer);
  if (status.contains(place)) text.sample({}, static_cast<double>(status.at(place).size()));
}

// `label`: a stateset's is called as its family.
void tell_one_of(const Json& status, OpenMetricsText& text, const char* pointer, std::string_view label,
                 std::initializer_list<const char*> states) {
  const Json::json_pointer place(pointer);
  if (!status.contains(place)) return;
  for (const char* state : states)
    text.sample({{label, state}}, status.at(place) == state ? 1 : 0);
}

void tell_each(const Json& status, OpenMetricsText& text, const char* list, const char* key) {
  if (!status.contains(list)) return;
  for (const Json& one : status.at(list)) {
    if (!one.contains(key) || !one.at(key).is_number()) continue;
    text.sample({{"actuator", std::to_string(one.at("id").get<int>())}}, one.at(key).get<double>());
  }
}

}  // namespace

void tell_build(const Json& status, OpenMetricsText& text) {
  text.sample({{"side", status.at("side").get<std::string>()}, {"version", status.at("version").get<std::string>()}},
              1);
}
void tell_uptime(const Json& status, OpenMetricsText& text) {
  tell_number(status, text, "/uptime_s");
}
void tell_state(const Json& status, OpenMetricsText& text) {
  tell_one_of(status, text, "/state", "telehug_state", {"ok", "waiting", "paused", "stopped", "fault"});
}
void tell_problems(const Json& status, OpenMetricsText& text) {
  tell_size(status, text, "/problems");
}

void tell_peers(const Json& status, OpenMetricsText& text) {
  int connected = 0;
  if (status.contains("peers")) {
    for (const Json& peer : status.at("peers"))
      connected += peer.value("connected", false) ? 1 : 0;
  } else {
    connected = status.value("/peer/connected"_json_pointer, false) ? 1 : 0;
  }
  text.sample({}, connected);
}

void tell_round_trip(const Json& status, OpenMetricsText& text) {
  tell_number(status, text, "/peer/round_trip_ms", 1e-3);
}
void tell_one_way(const Json& status, OpenMetricsText& text) {
  tell_number(status, text, "/peer/one_way_ms", 1e-3);
}
void tell_camera_open(const Json& status, OpenMetricsText& text) {
  tell_number(status, text, "/camera/open");
}
void tell_camera_problems(const Json& status, OpenMetricsText& text) {
  tell_size(status, text, "/camera/problems");
}
void tell_face(const Json& status, OpenMetricsText& text) {
  tell_number(status, text, "/face/found");
}
void tell_jacket_state(const Json& status, OpenMetricsText& text) {
  tell_one_of(status, text, "/jacket/state", "telehug_jacket_state", {"absent", "connecting", "armed"});
}
void tell_supply(const Json& status, OpenMetricsText& text) {
  tell_number(status, text, "/jacket/supply_v");
}
void tell_running(const Json& status, OpenMetricsText& text) {
  tell_size(status, text, "/jacket/running");
}
void tell_duty(const Json& status, OpenMetricsText& text) {
  tell_each(status, text, "duty", "used");
}
void tell_heaters(const Json& status, OpenMetricsText& text) {
  tell_each(status, text, "heaters", "celsius");
}
void tell_set_points(const Json& status, OpenMetricsText& text) {
  tell_each(status, text, "heaters", "set_point_celsius");
}

}  // namespace telehug::status_numbers
