// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "ctl/doctor/checks.hpp"

namespace telehug {

[[nodiscard]] bool anything_fails(const Findings& findings);

// "LEVEL CHECK WHAT", and what mends it on a line of its own behind "->".
[[nodiscard]] std::string doctor_text(const Findings& findings);
// {"findings": [{"check", "level", "what", "fix"}]}
[[nodiscard]] nlohmann::json doctor_json(const Findings& findings);

}  // namespace telehug
