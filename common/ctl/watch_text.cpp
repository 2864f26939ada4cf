// SPDX-License-Identifier: Apache-2.0
#include "ctl/watch_text.hpp"

#include <fmt/core.h>

#include "ctl/plain_text.hpp"

namespace telehug {

std::string watch_text(const nlohmann::json& event) {
  const auto at = [&](const char* name) { return event.contains(name) ? text_of(event[name]) : std::string("-"); };
  std::string text = fmt::format("{:<8} {:<10}", at("side"), at("event"));
  for (const auto& [name, value] : event.items()) {
    if (name != "side" && name != "event") text += fmt::format(" {}={}", plain_text(name), text_of(value));
  }
  return text;
}

}  // namespace telehug
