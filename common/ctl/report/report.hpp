// SPDX-License-Identifier: Apache-2.0
//
// What `telehug report` writes, a section a function: of values that were gathered, without what is nobody else's
// business.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/config_report.hpp"
#include "ctl/report/masker.hpp"

namespace telehug {

// What of a configuration must not be told becomes hidden: every text that a person wrote into it.
void hide_texts_of(const ConfigReport& report, Masker& masker);
// What differs from the defaults. Numbers, switches and choices as they are; of a text only that it is set, and of
// "serial:PATH" and its like the first word.
[[nodiscard]] std::string config_section(const ConfigReport& report, Side side, const Masker& masker);

// Names, phrases, ids and reasons.
void hide_texts_of(const nlohmann::json& status, Masker& masker);
// Only what is known to be of no person: state, problems, counters, latencies, and whether devices work.
[[nodiscard]] std::string status_section(const nlohmann::json& status, const Masker& masker);

// Of a calibration file: its date, sizes, model, how many touches, and their errors. Empty text: there is none.
[[nodiscard]] std::string calibration_section(const std::string& toml_text);

// Of a jacket profile. `installed`: it is one of telehug's; of others the name is not told.
[[nodiscard]] std::string jacket_section(const std::string& toml_text, bool installed, const nlohmann::json& status);

}  // namespace telehug
