// SPDX-License-Identifier: Apache-2.0
//
// JSON as a text that survives a chat window: BEGIN and END lines, Base64 between them; whatever else stands around it
// and however its lines were broken or indented.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "common/result.hpp"

namespace telehug {

inline constexpr std::size_t max_armoured_size = 64 * 1024;  // bytes of text

// kind: "request", "grant" or "renewal".
[[nodiscard]] std::string armour(const std::string& kind, const nlohmann::json& content);
[[nodiscard]] Result<nlohmann::json> unarmour(const std::string& kind, const std::string& text);
// Is there the beginning of one in the text?
[[nodiscard]] bool holds(const std::string& kind, const std::string& text);

// A value of what was unarmoured; empty if it is absent or no text.
[[nodiscard]] std::string text_in(const nlohmann::json& json, const char* name);

}  // namespace telehug
