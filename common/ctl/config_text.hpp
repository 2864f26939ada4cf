// SPDX-License-Identifier: Apache-2.0
//
// What `telehug config` says of a side's configuration.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "config/config_report.hpp"

namespace telehug {

// A fault a line: "FILE:LINE: sentence"; else one line that there is none, and what was read.
[[nodiscard]] std::string config_check_text(const ConfigReport& report, Side side);
// A TOML file that holds every key, each with where its value comes from.
[[nodiscard]] std::string config_show_text(const ConfigReport& report, Side side);
// A line for each key whose value is not its default.
[[nodiscard]] std::string config_diff_text(const ConfigReport& report, Side side);

// {"side", "files", "faults": [{"where", "what"}], "keys": {"section.key": {"value", "default", "from"}}}
[[nodiscard]] nlohmann::json config_json(const ConfigReport& report, Side side);

}  // namespace telehug
