// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace telehug {

// An event as one line for a person: its side and kind, then everything else as name=value.
[[nodiscard]] std::string watch_text(const nlohmann::json& event);

}  // namespace telehug
