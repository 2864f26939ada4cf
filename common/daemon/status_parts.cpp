// SPDX-License-Identifier: Apache-2.0
#include "daemon/status_parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "daemon/membership.hpp"
#include "daemon/peer_absence.hpp"
#include "peer_link/pair_over.hpp"

namespace telehug {

nlohmann::json problem_json(std::string what, std::string to_do) {
  return {{"what", std::move(what)}, {"do", std::move(to_do)}};
}

nlohmann::json peer_stop_problem_json(const ConnectionStatus& connection) {
  const auto& told = connection.told;
  const std::string why = told && told->stopped && !told->reason.empty() ? ": " + told->reason : "";
  return problem_json(connection.name() + " has stopped everything" + why, "ask them to run `telehug resume`");
}

nlohmann::json peer_json(const ConnectionStatus& connection) {
  const PeerState& peer = connection.peer;
  const auto& told = connection.told;
  nlohmann::json json = {{"connected", peer.alive}, {"session", peer.session}};
  const auto to_us_exact_ms = [](Duration duration) { return std::round(to_ms(duration) * 1000) / 1000; };
  if (peer.round_trip) json["round_trip_ms"] = to_us_exact_ms(*peer.round_trip);
  if (peer.one_way) json["one_way_ms"] = to_us_exact_ms(*peer.one_way);
  if (told && peer.alive) {
    json["stopped"] = told->stopped;
    json["ready"] = told->ready;
    json["reason"] = told->reason;
  }
  return json;
}

void add_connections(nlohmann::json& status, const std::vector<ConnectionStatus>& connections) {
  if (connections.empty()) return;
  const auto alive = std::ranges::find_if(connections, [](const auto& connection) { return connection.peer.alive; });
  const ConnectionStatus& first = alive != connections.end() ? *alive : connections.front();
  status["peer"] = peer_json(first);
  status["link"] = first.link;
  if (first.pair) status["pair"] = pair_json(*first.pair);
  if (connections.size() == 1) return;
  for (const ConnectionStatus& connection : connections) {
    nlohmann::json peer = peer_json(connection);
    peer["name"] = connection.name();
    peer["link"] = connection.link;
    if (connection.pair) peer["pair"] = pair_json(*connection.pair);
    status["peers"].push_back(std::move(peer));
  }
}

void add_pair_ends(nlohmann::json& problems, const std::vector<ConnectionStatus>& connections) {
  for (const ConnectionStatus& connection : connections) {
    if (!connection.pair) continue;
    if (auto ends = pair_end_problem(*connection.pair, wall_time())) problems.push_back(*std::move(ends));
  }
}

void add_absences(nlohmann::json& problems, Side own, const std::vector<ConnectionStatus>& connections) {
  const bool alive = any_alive(connections);
  std::vector<std::string> said;
  for (const ConnectionStatus& connection : connections) {
    const bool over = connection.told && connection.told->reason == pair_over_reason;
    if (connection.peer.alive || (alive && !over)) continue;
    const PeerAbsence absence = peer_absence(own, connection.pair.has_value(), connection.told, connection.stranger);
    const std::string what = alive ? connection.name() + ": " + absence.what : absence.what;
    if (std::ranges::find(said, what) != said.end()) continue;
    said.push_back(what);
    problems.push_back(problem_json(what, absence.to_do));
  }
}

void count_connections(nlohmann::json& counters, const std::vector<ConnectionStatus>& connections) {
  std::uint64_t losses = 0;
  std::uint64_t dropped = 0;
  std::uint64_t refusals = 0;
  for (const ConnectionStatus& connection : connections) {
    losses += connection.peer.losses;
    dropped += connection.dropped;
    refusals += connection.refusals;
  }
  counters["peer_losses"] = losses;
  counters["messages_dropped"] = dropped;
  counters["peers_refused"] = refusals;
}

bool any_alive(const std::vector<ConnectionStatus>& connections) {
  return std::ranges::any_of(connections, [](const auto& connection) { return connection.peer.alive; });
}

}  // namespace telehug
