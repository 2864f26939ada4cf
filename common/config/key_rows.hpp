// SPDX-License-Identifier: Apache-2.0
//
// Rows and checks of keys that both sides have, and what their tables are made with.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "config/key.hpp"

namespace telehug {

using Rows = std::vector<Key>;

void append(Rows& rows, const Rows& more);

[[nodiscard]] Rows peer_rows(PeerConfig& config);
[[nodiscard]] Rows common_rows(ControlConfig& control, WebConfig& web, LogConfig& log);

// Faults that no key of the peer has alone.
[[nodiscard]] std::vector<Fault> impossible_peers(const PeerConfig& config, const std::vector<Key>& keys);

// Where the first of these that was set was set.
[[nodiscard]] std::string place_of(const std::vector<Key>& keys, std::initializer_list<std::string_view> paths);

// A text is fine if `parse` can read it.
template <typename Parser>
TextCheck parsed_by(Parser parse) {
  return [parse](std::string_view text) -> std::optional<std::string> {
    const auto parsed = parse(text);
    return parsed ? std::nullopt : std::optional(parsed.error().message);
  };
}

}  // namespace telehug
