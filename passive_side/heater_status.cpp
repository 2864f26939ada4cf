// SPDX-License-Identifier: Apache-2.0
#include "heater_status.hpp"

#include <cmath>

#include "link/jacket_telemetry.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

const char* name_of(HeaterState state) {
  constexpr const char* names[] = {"ready", "no telemetry", "no reading", "fault", "too warm", "cooling down"};
  return names[static_cast<std::size_t>(state)];
}

Json rounded(double celsius) {
  return std::round(celsius * 10) / 10;
}

// Empty while it heats.
std::string why_off(const HeaterReport& heater, const HeaterSurroundings& around) {
  if (heater.set_point_celsius > 0) return "";
  if (!around.jacket_answers) return "no jacket answers";
  if (heater.state != HeaterState::ready) return heater_state_text(heater);
  if (!around.enabled) return "the wearer's own limits have switched it off";
  if (!around.refusal.empty()) return around.refusal;
  return around.muted ? "the wearer has muted it" : "no hand warms it";
}

}  // namespace

std::string heater_state_text(const HeaterReport& heater) {
  using protocol::HeaterFault;
  switch (heater.state) {
    case HeaterState::ready:
      return "";
    case HeaterState::no_telemetry:
      return "nothing has been heard of its temperature for 2 s";
    case HeaterState::no_reading:
      return "its sensor tells no temperature";
    case HeaterState::too_warm:
      return "its sensor tells 41 C or more";
    case HeaterState::cooling_down:
      return "it has heated for 10 minutes and cools down";
    case HeaterState::fault:
      break;
  }
  switch (heater.fault) {
    case HeaterFault::sensor_open:
      return "its temperature sensor is not connected";
    case HeaterFault::sensor_short:
      return "its temperature sensor has a short circuit";
    case HeaterFault::too_hot:
      return "it was too hot";
    case HeaterFault::no_rise:
      return "its sensor got no warmer while it heated: one of them has come off";
    case HeaterFault::rises_too_fast:
      return "it got warm too fast";
    case HeaterFault::none:
    case HeaterFault::cooling_down:
      break;
  }
  return "the jacket reports a fault of it";
}

Json heater_json(const HeaterReport& heater, const std::string& name, const HeaterSurroundings& around) {
  Json json{{"id", heater.id},
            {"name", name},
            {"state", name_of(heater.state)},
            {"fault", heater_fault_text(heater.fault)},
            {"set_point_celsius", rounded(heater.set_point_celsius)}};
  if (heater.celsius && std::isfinite(*heater.celsius)) json["celsius"] = rounded(*heater.celsius);
  if (const std::string why = why_off(heater, around); !why.empty()) json["why"] = why;
  return json;
}

}  // namespace telehug
