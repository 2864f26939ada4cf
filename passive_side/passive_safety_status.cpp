// SPDX-License-Identifier: Apache-2.0
//
// What the passive daemon tells people of its limits, heaters and of what the wearer wants.
#include <fmt/core.h>

#include <cmath>

#include "daemon/status_parts.hpp"
#include "passive_daemon.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

const char* name_of(HeaterState state) {
  constexpr const char* names[] = {"ready", "no telemetry", "no reading", "fault", "too warm", "cooling down"};
  return names[static_cast<std::size_t>(state)];
}

// Completes "the heater ... is off: ".
std::string sentence(const HeaterReport& heater) {
  using protocol::HeaterFault;
  if (heater.state == HeaterState::no_telemetry) return "nothing has been heard of its temperature for 2 s";
  if (heater.state == HeaterState::no_reading) return "its sensor tells no temperature";
  if (heater.state == HeaterState::too_warm) return "its sensor tells 41 C or more";
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

Json celsius_json(double celsius) {
  return std::round(celsius * 10) / 10;
}

}  // namespace

std::string PassiveDaemon::actuator_name(std::uint8_t id) const {
  const auto index = profile_.index_of(id);
  return index ? profile_.actuators[*index].name : "";
}

void PassiveDaemon::add_safety_problems(Json& list, const DriveThreadState& now) const {
  const Consent consent = consent_.consent();
  if (const Json problem = consent_.problem(); !problem.is_null()) {
    list.push_back(problem);
  } else if (consent.pause) {
    if (const std::string why = refusal_text(consent, wall_time()); !why.empty()) {
      list.push_back(problem_json(why + ": nothing is felt", "run `telehug unpause`"));
    }
  }
  if (now.link.state != LinkState::armed) return;
  for (const HeaterReport& heater : now.heaters) {
    if (heater.state == HeaterState::ready || heater.state == HeaterState::cooling_down) continue;
    list.push_back(problem_json(fmt::format("the heater \"{}\" is off: {}", actuator_name(heater.id), sentence(heater)),
                                "take the jacket off, check the heater, its sensor and their cables, then unplug the "
                                "jacket and plug it in again; the motors go on without it"));
  }
}

void PassiveDaemon::add_safety_status(Json& answer, const DriveThreadState& now) const {
  answer["consent"] = consent_json(consent_.consent(), wall_time());
  if (now.heaters.empty()) return;
  Json heaters = Json::array();
  for (const HeaterReport& heater : now.heaters) {
    Json json{{"id", heater.id}, {"name", actuator_name(heater.id)}, {"state", name_of(heater.state)}};
    json["set_point_celsius"] = celsius_json(heater.set_point_celsius);
    if (heater.celsius && std::isfinite(*heater.celsius)) json["celsius"] = celsius_json(*heater.celsius);
    heaters.push_back(std::move(json));
  }
  answer["heaters"] = std::move(heaters);
}

void PassiveDaemon::add_safety_counters(Json& counters, const SafetyCounters& safety) {
  counters["safety_accepted"] = safety.drives_accepted;
  counters["safety_refused_unknown_actuator"] = safety.refused_unknown_actuator;
  counters["safety_refused_not_finite"] = safety.refused_not_finite;
  counters["safety_refused_by_limit"] = safety.refused_by_limit;
  counters["safety_refused_muted"] = safety.refused_muted;
  counters["safety_refused_stopped"] = safety.refused_stopped;
  counters["safety_refused_paused"] = safety.refused_paused;
  counters["safety_refused_quiet_hours"] = safety.refused_quiet_hours;
  counters["safety_refused_no_sender"] = safety.refused_no_sender;
  counters["safety_refused_no_jacket"] = safety.refused_no_jacket;
  counters["safety_clamped_strength"] = safety.clamped_strength;
  counters["safety_clamped_end"] = safety.clamped_end;
  counters["safety_limited_by_duty"] = safety.limited_by_duty;
  counters["safety_limited_by_current"] = safety.limited_by_current;
  counters["safety_limited_by_heater"] = safety.limited_by_heater;
  counters["off_ended"] = safety.off_ended;
  counters["off_expired"] = safety.off_expired;
  counters["off_stop"] = safety.off_stop;
  counters["off_consent"] = safety.off_consent;
  counters["off_asked"] = safety.off_asked;
  counters["off_heartbeat_lost"] = safety.off_heartbeat_lost;
  counters["off_link_lost"] = safety.off_link_lost;
  counters["off_clock_jumped"] = safety.off_clock_jumped;
}

void PassiveDaemon::tell_of_limits() {
  if (const auto note = limit_notes_.next(state().safety, clock_.now())) spdlog::info("{}", *note);
  const std::string refusal = refusal_text(consent_.consent(), wall_time());
  say_consent_.say(spdlog::level::info, refusal.empty() ? "touches may be felt" : refusal + ": nothing is felt");
}

}  // namespace telehug
