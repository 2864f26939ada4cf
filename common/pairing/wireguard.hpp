// SPDX-License-Identifier: Apache-2.0
//
// A pair's WireGuard tunnel: one file for wg-quick(8) on each PC, made while the two are paired. Which PC has which
// address follows from the pair's id, so that nobody is told which addresses to let in. IPv4, since DDS speaks it
// alone.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/result.hpp"
#include "pairing/pairing.hpp"

namespace telehug {

inline constexpr const char* usual_tunnel_port = "51820";

// Tells the other PC what it needs of this one. Keys are X25519, in Base64.
struct TunnelOffer {
  std::string public_key;
  std::string endpoint;  // see parse_tunnel_endpoint(); empty: this PC can't be dialled
};

// This PC's end.
struct TunnelEnd {
  std::string secret_key;
  TunnelOffer offer;
};

// "HOST", "HOST:PORT", "2001:db8::7" or "[2001:db8::7]:PORT" with the port filled in.
[[nodiscard]] Result<std::string> parse_tunnel_endpoint(const std::string& text);

// With fresh keys. Throws std::runtime_error (a sentence) if OpenSSL can't, or nobody can dial there; empty: nowhere.
[[nodiscard]] TunnelEnd make_tunnel_end(const std::string& reachable_at);

// To be kept until the other PC answered.
[[nodiscard]] std::string to_text(const TunnelEnd& end);
[[nodiscard]] std::optional<TunnelEnd> read_tunnel_end(const std::string& text);

// As a part of a request or grant.
[[nodiscard]] nlohmann::json to_json(const TunnelOffer& offer);
// Nothing if there is none; an error if it is not what it should be: it comes from outside, and root will read it.
[[nodiscard]] Result<std::optional<TunnelOffer>> tunnel_offer_in(const nlohmann::json& text);

// The content of wg-quick's file on the PC that is `side`.
[[nodiscard]] std::string wireguard_conf(const std::string& id, Side side, const TunnelEnd& own,
                                         const TunnelOffer& other);

[[nodiscard]] inline std::filesystem::path wireguard_file_in(const std::filesystem::path& folder) {
  return folder / "wireguard.conf";
}

struct PairTunnel {
  std::filesystem::path file;
  std::string interface;  // as wg-quick is to call it
  std::string own_address;
  std::string peer_address;
  std::string listen_port;  // UDP, to be forwarded to this PC; empty: it dials
};

// Of a pair that has one.
[[nodiscard]] std::optional<PairTunnel> tunnel_of(const Pair& pair);

}  // namespace telehug
