// SPDX-License-Identifier: Apache-2.0
//
// JSON that comes from outside. nlohmann's values are copied and printed recursively, so that 60 kB of brackets take
// megabytes of stack: what is nested more deeply than anything of ours is refused.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace telehug {

inline constexpr int deepest_json = 64;

// Discarded if it is no JSON, or nested too deeply.
[[nodiscard]] inline nlohmann::json parse_outside_json(std::string_view text) {
  bool too_deep = false;
  const auto goes_on = [&too_deep](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
    too_deep = too_deep || depth > deepest_json;
    return !too_deep;
  };
  auto json = nlohmann::json::parse(text, goes_on, false);
  return too_deep ? nlohmann::json(nlohmann::json::value_t::discarded) : json;
}

}  // namespace telehug
