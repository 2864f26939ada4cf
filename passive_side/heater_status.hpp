// SPDX-License-Identifier: Apache-2.0
//
// What a status tells of the heaters (common/ctl/README.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "safety/safety_values.hpp"

namespace telehug {

// What keeps a heater off beside itself.
struct HeaterSurroundings {
  bool jacket_answers = true;
  std::string refusal{};  // "stopped: bed time", "paused until 15:30"; empty: nothing is refused
  bool muted = false;     // by the wearer
  bool enabled = true;    // in the profile
};

// Completes "the heater ... is off: " for a state in which it must not heat.
[[nodiscard]] std::string heater_state_text(const HeaterReport& heater);

// {"id", "name", "state", "fault", "set_point_celsius"}, with "celsius" where that is known and "why" where it is off.
[[nodiscard]] nlohmann::json heater_json(const HeaterReport& heater, const std::string& name,
                                         const HeaterSurroundings& around);

}  // namespace telehug
