// SPDX-License-Identifier: Apache-2.0
#include "daemon/status_parts.hpp"

#include <cmath>
#include <utility>

namespace telehug {

nlohmann::json problem_json(std::string what, std::string to_do) {
  return {{"what", std::move(what)}, {"do", std::move(to_do)}};
}

nlohmann::json peer_stop_problem_json(const std::optional<SideStatus>& told) {
  const std::string why = told && told->stopped && !told->reason.empty() ? ": " + told->reason : "";
  return problem_json("the other side has stopped everything" + why, "ask them to run `telehug resume`");
}

nlohmann::json peer_json(const PeerState& peer, const std::optional<SideStatus>& told) {
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

}  // namespace telehug
