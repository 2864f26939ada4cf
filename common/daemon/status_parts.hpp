// SPDX-License-Identifier: Apache-2.0
//
// Parts of the status that both daemons tell (common/ctl/README.md).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "peer_link/peer_link.hpp"

namespace telehug {

// What is wrong, and what the user can do about it.
[[nodiscard]] nlohmann::json problem_json(std::string what, std::string to_do);

// The peer has stopped everything.
[[nodiscard]] nlohmann::json peer_stop_problem_json(const std::optional<SideStatus>& told);

// `told`: what the peer last told of itself, if it has.
[[nodiscard]] nlohmann::json peer_json(const PeerState& peer, const std::optional<SideStatus>& told);

}  // namespace telehug
