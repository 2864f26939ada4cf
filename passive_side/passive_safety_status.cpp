// SPDX-License-Identifier: Apache-2.0
//
// What the passive daemon tells people of its limits, heaters and of what the wearer wants.
#include <fmt/core.h>

#include "daemon/status_parts.hpp"
#include "heater_status.hpp"
#include "passive_daemon.hpp"
#include "safety/muted_place.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

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
    list.push_back(
        problem_json(fmt::format("the heater \"{}\" is off: {}", actuator_name(heater.id), heater_state_text(heater)),
                     "take the jacket off, check the heater, its sensor and their cables, then unplug the "
                     "jacket and plug it in again; the motors go on without it"));
  }
}

void PassiveDaemon::add_safety_status(Json& answer, const DriveThreadState& now) const {
  const Consent consent = consent_.consent();
  const WallTime time = wall_time();
  answer["consent"] = consent_json(consent, time);
  answer["duty"] = Json::array();
  for (const DutyReport& motor : now.duties)
    answer["duty"].push_back({{"id", motor.id}, {"used", motor.used}});
  if (now.heaters.empty()) return;
  const std::string refusal = now.stopped ? "stopped: " + now.stop_reason : refusal_text(consent, time);
  const Permission permission = permission_at(consent, time, local_minute(time));
  Json heaters = Json::array();
  for (const HeaterReport& heater : now.heaters) {
    const Actuator& actuator = profile_.actuators.at(profile_.index_of(heater.id).value());
    heaters.push_back(heater_json(heater, actuator.name,
                                  {.jacket_answers = now.link.state == LinkState::armed,
                                   .refusal = refusal,
                                   .muted = is_muted(actuator.id, actuator.place, permission),
                                   .enabled = actuator.enabled}));
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
  if (const auto note = limit_notes_.next(state().safety, clock_.now()))
    log_about({.stage = "safety"}, spdlog::level::info, *note);
  const std::string refusal = refusal_text(consent_.consent(), wall_time());
  say_consent_.say(spdlog::level::info, refusal.empty() ? "touches may be felt" : refusal + ": nothing is felt",
                   {.stage = "consent"});
}

}  // namespace telehug
