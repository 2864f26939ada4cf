// SPDX-License-Identifier: Apache-2.0
#include "jacket_status.hpp"

#include <fmt/core.h>

#include "daemon/status_parts.hpp"
#include "link/jacket_telemetry.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

const char* name_of(LinkState state) {
  constexpr const char* names[] = {"absent", "connecting", "armed"};
  return names[static_cast<std::size_t>(state)];
}

Json heaters_json(const JacketTelemetry& telemetry) {
  Json heaters = Json::array();
  for (const auto& heater : telemetry.heaters) {
    heaters.push_back(
        {{"celsius", heater.celsius ? Json(*heater.celsius) : Json()}, {"fault", heater_fault_text(heater.fault)}});
  }
  return heaters;
}

}  // namespace

Json jacket_json(const std::string& name, const LinkStatus& link, std::span<const std::uint8_t> running) {
  Json jacket = {{"name", name},
                 {"device", link.device},
                 {"state", name_of(link.state)},
                 {"firmware", link.firmware_version},
                 {"motors", link.motor_count},
                 {"running", Json::array()}};
  for (const std::uint8_t id : running)
    jacket["running"].push_back(id);
  if (!link.answers) jacket["note"] = "it answers nothing: whether it is there, nobody knows";
  if (!link.telemetry) return jacket;
  if (link.telemetry->supply_volts > 0) jacket["supply_v"] = link.telemetry->supply_volts;
  jacket["last_reset"] = reset_cause_text(link.telemetry->reset_cause);
  jacket["frames_it_refused"] = link.telemetry->frames_malformed;
  jacket["bytes_it_lost"] = link.telemetry->bytes_overrun;
  if (!link.telemetry->heaters.empty()) jacket["heaters"] = heaters_json(*link.telemetry);
  return jacket;
}

void add_jacket_problems(Json& problems, const LinkStatus& link) {
  if (link.state != LinkState::armed) {
    problems.push_back(problem_json(fmt::format("no jacket answers on {}: {}", link.device, link.problem),
                                    "check its cable and power, and [jacket] link in the configuration"));
  }
  if (!link.telemetry) return;
  for (const JacketWarning& warning : warnings(*link.telemetry))
    problems.push_back(problem_json(warning.what, std::string(warning.to_do)));
}

}  // namespace telehug
