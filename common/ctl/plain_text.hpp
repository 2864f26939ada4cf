// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace telehug {

// For the terminal: control characters, which could move its cursor or change its title, become '?', those of ISO 8859
// (U+0080 to U+009F) among them. Texts come from the peer and from devices.
[[nodiscard]] inline std::string plain_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool second = !out.empty() && out.back() == '\xC2' && byte >= 0x80 && byte < 0xA0;
    if (second) out.pop_back();
    out += second || byte < 0x20 || byte == 0x7F ? '?' : c;
  }
  return out;
}

// A value in a sentence: texts without quotes, yes and no, everything else as JSON.
[[nodiscard]] inline std::string text_of(const nlohmann::json& value) {
  if (value.is_string()) return plain_text(value.get_ref<const std::string&>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return plain_text(value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace telehug
