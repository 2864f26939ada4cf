// SPDX-License-Identifier: Apache-2.0
//
// Parts of the status that both daemons tell (common/ctl/README.md).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "dds/strangers.hpp"
#include "pairing/pairing.hpp"
#include "peer_link/peer_link.hpp"

namespace telehug {

// What is wrong, and what the user can do about it.
[[nodiscard]] nlohmann::json problem_json(std::string what, std::string to_do);

// For sentences: what this PC calls the other one.
[[nodiscard]] inline std::string name_of(const std::optional<Pair>& pair) {
  return pair ? pair->name : "the other side";
}

// One connection, as far as a status tells of it.
struct ConnectionStatus {
  std::optional<Pair> pair;
  PeerState peer;
  std::optional<SideStatus> told;  // what the peer last told of itself, if it has
  nlohmann::json link;             // LinkKeeper's
  bool stopped_by_peer = false;
  std::uint64_t dropped = 0;  // messages that were malformed or out of range
  std::optional<Stranger> stranger;
  std::uint64_t refusals = 0;  // of peers that do not belong to the pair

  [[nodiscard]] std::string name() const { return name_of(pair); }
};

// This peer has stopped everything.
[[nodiscard]] nlohmann::json peer_stop_problem_json(const ConnectionStatus& connection);

// What is known of the peer.
[[nodiscard]] nlohmann::json peer_json(const ConnectionStatus& connection);

// Adds "peer", "link" and "pair" to a status: of the first connection whose peer is there, or else the first. If there
// are several, also "peers", with all of them.
void add_connections(nlohmann::json& status, const std::vector<ConnectionStatus>& connections);

// Adds a problem for each pair that ends soon.
void add_pair_ends(nlohmann::json& problems, const std::vector<ConnectionStatus>& connections);

// Adds why nobody is connected, or why one of several whose pair is over is not.
void add_absences(nlohmann::json& problems, Side own, const std::vector<ConnectionStatus>& connections);

// Adds "peer_losses", "peers_refused" and "messages_dropped" of all of them together.
void count_connections(nlohmann::json& counters, const std::vector<ConnectionStatus>& connections);

[[nodiscard]] bool any_alive(const std::vector<ConnectionStatus>& connections);

}  // namespace telehug
