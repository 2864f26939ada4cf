// SPDX-License-Identifier: Apache-2.0
#include "daemon/membership.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>

#include "config/locator.hpp"
#include "config/places.hpp"
#include "pairing/wireguard.hpp"

namespace telehug {
namespace {

std::string date(WallTime time) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

std::string ids(const std::vector<Pair>& pairs) {
  std::string text;
  for (const Pair& pair : pairs)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", pair.id, pair.name);
  return text;
}

Result<std::optional<Pair>> choose(const std::vector<Pair>& pairs, const std::string& wanted) {
  if (wanted.empty()) {
    if (pairs.empty()) return std::optional<Pair>();
    if (pairs.size() == 1) return std::optional(pairs.front());
    return Error{fmt::format("this PC has several pairs: say which by peer.pair: {}", ids(pairs))};
  }
  const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const Pair& pair) { return pair.id == wanted; });
  if (found != pairs.end()) return std::optional(*found);
  return Error{
      fmt::format("peer.pair is {}, which is no pair of this PC; there {}", wanted,
                  pairs.empty() ? "are none: `telehug pair --help` says how to make one" : "is: " + ids(pairs))};
}

Error broken(const Pair& pair, const std::vector<PairingFault>& faults) {
  std::string text = fmt::format("the pair with {} ({}) can't be used:", pair.name, pair.id);
  for (const PairingFault& fault : faults)
    text += fmt::format("\n  {}: {} To do: {}", fault.file.string(), fault.what, fault.to_do);
  return {text};
}

}  // namespace

Result<Membership> membership(const PeerConfig& config, Side side, WallTime now) {
  Membership member;
  member.dds.side = side;
  member.dds.domain_id = static_cast<std::uint32_t>(config.domain);
  if (!config.partition.empty()) member.dds.partition = config.partition;
  try {
    const PairStore store(pairs_folder(config, side), side);
    const auto chosen = choose(store.list(), config.pair);
    if (!chosen) return chosen.error();
    member.pair = *chosen;
    if (!member.pair) return member;
    if (const auto faults = store.preflight(*member.pair, now); !faults.empty()) return broken(*member.pair, faults);
  } catch (const std::exception& problem) {
    return Error{fmt::format("the pairs of this PC can't be read: {}", problem.what())};
  }
  member.dds.security = member.pair->files;
  member.dds.partition = member.pair->partition;
  member.dds.loopback_only = config.loopback_only;
  if (auto addresses = parse_addresses(config.addresses)) member.dds.peers = *std::move(addresses);
  if (const auto tunnel = tunnel_of(*member.pair); tunnel && !config.loopback_only)
    member.dds.peers.push_back(tunnel->peer_address);
  if (!config.public_address.empty())
    member.dds.public_address = {config.public_address, static_cast<std::uint16_t>(config.public_port)};
  return member;
}

std::optional<std::string> pair_over(const Membership& membership, WallTime now) {
  if (!membership.pair) return {};
  const Pair& pair = *membership.pair;
  std::error_code ignored;
  if (!std::filesystem::exists(pair.files.private_key, ignored)) {
    return fmt::format("the pair with {} was revoked on this PC", pair.name);
  }
  if (now >= pair.expires) {
    return fmt::format("the pair with {} has expired on {}: pair the two PCs again (`telehug pair --help`)", pair.name,
                       date(pair.expires));
  }
  return {};
}

nlohmann::json pair_json(const Pair& pair) {
  return {{"id", pair.id}, {"name", pair.name}, {"phrase", pair.phrase}, {"expires", date(pair.expires)}};
}

std::string describe(const Membership& membership) {
  if (!membership.pair) {
    return "not paired: only a peer on this PC is heard; `telehug pair --help` says how to pair it with another one";
  }
  return fmt::format("paired with {} until {}{}", membership.pair->name, date(membership.pair->expires),
                     membership.dds.loopback_only ? "; only on this PC (peer.loopback_only)" : "");
}

}  // namespace telehug
