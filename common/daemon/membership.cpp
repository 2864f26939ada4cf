// SPDX-License-Identifier: Apache-2.0
#include "daemon/membership.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "config/locator.hpp"
#include "config/places.hpp"
#include "daemon/status_parts.hpp"
#include "pairing/wireguard.hpp"

namespace telehug {
namespace {

constexpr auto end_is_near = std::chrono::hours(24 * 14);

std::string date(WallTime time) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

std::string ids(const std::vector<Pair>& pairs) {
  std::string text;
  for (const Pair& pair : pairs)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", pair.id, pair.name);
  return text;
}

Result<std::vector<Pair>> choose(std::vector<Pair> pairs, const std::string& wanted, Side side) {
  if (wanted.empty() && side == Side::active && pairs.size() > 1) {
    return Error{
        fmt::format("this PC has several pairs: say by peer.pairs whom it touches (\"all\", or ids): {}", ids(pairs))};
  }
  if (wanted.empty() || wanted == "all") return pairs;
  const auto wanted_ids = parse_pairs(wanted);
  if (!wanted_ids) return wanted_ids.error();
  std::vector<Pair> chosen;
  for (const std::string& id : *wanted_ids) {
    const auto found = std::ranges::find(pairs, id, &Pair::id);
    if (found == pairs.end()) {
      return Error{
          fmt::format("peer.pairs names {}, which is no pair of this PC; there {}", id,
                      pairs.empty() ? "are none: `telehug pair --help` says how to make one" : "is: " + ids(pairs))};
    }
    if (std::ranges::find(chosen, id, &Pair::id) == chosen.end()) chosen.push_back(*found);
  }
  return chosen;
}

std::string broken(const Pair& pair, const std::vector<PairingFault>& faults) {
  std::string text = fmt::format("the pair with {} ({}) can't be used:", pair.name, pair.id);
  for (const PairingFault& fault : faults)
    text += fmt::format("\n  {}: {} To do: {}", fault.file.string(), fault.what, fault.to_do);
  return text;
}

}  // namespace

Result<Memberships> memberships(const PeerConfig& config, Side side, WallTime now) {
  Membership unpaired;
  unpaired.dds.side = side;
  unpaired.dds.domain_id = static_cast<std::uint32_t>(config.domain);
  if (!config.partition.empty()) unpaired.dds.partition = config.partition;
  Memberships found;
  try {
    const PairStore store(pairs_folder(config, side), side);
    const auto chosen = choose(store.list(), config.pairs, side);
    if (!chosen) return chosen.error();
    if (chosen->empty()) return Memberships{{unpaired}, {}};
    const auto addresses = parse_addresses(config.addresses);
    bool only_dates = true;
    for (const Pair& pair : *chosen) {
      if (const auto faults = store.preflight(pair, now); !faults.empty()) {
        found.left_out.push_back(broken(pair, faults));
        only_dates = only_dates && std::ranges::all_of(faults, &PairingFault::by_date);
        continue;
      }
      Membership& member = found.members.emplace_back(unpaired);
      member.pair = pair;
      member.dds.security = pair.files;
      member.dds.partition = pair.partition;
      member.dds.loopback_only = config.loopback_only;
      if (addresses) member.dds.peers = *addresses;
      if (const auto tunnel = tunnel_of(pair); tunnel && !config.loopback_only)
        member.dds.peers.push_back(tunnel->peer_address);
      if (!config.public_address.empty())
        member.dds.public_address = {config.public_address, static_cast<std::uint16_t>(config.public_port)};
    }
    if (found.members.empty() && !only_dates) return Error{why_none(found)};
    if (found.members.size() > 1 && !config.public_address.empty()) {
      return Error{fmt::format(
          "the two UDP ports from peer.public_port on serve one pair: choose by peer.pairs which: {}", ids(*chosen))};
    }
    if (found.members.size() > max_memberships) {
      return Error{fmt::format("one daemon serves at most {} pairs: choose by peer.pairs which of these it serves: {}",
                               max_memberships, ids(*chosen))};
    }
  } catch (const std::exception& problem) {
    return Error{fmt::format("the pairs of this PC can't be read: {}", problem.what())};
  }
  return found;
}

std::string why_none(const Memberships& none) {
  return fmt::format("{}", fmt::join(none.left_out, "\n"));
}

bool same_pair(const Membership& a, const Membership& b) {
  return (a.pair ? a.pair->id : "") == (b.pair ? b.pair->id : "");
}

std::optional<std::string> pair_over(const Membership& membership, WallTime now) {
  if (!membership.pair) return {};
  const Pair& pair = *membership.pair;
  std::error_code ignored;
  if (!std::filesystem::exists(pair.files.private_key, ignored)) {
    return fmt::format("the pair with {} was revoked on this PC", pair.name);
  }
  if (now < pair.expires) return {};
  const WallTime expires = present(pair).expires;
  if (now < expires) return {};
  return fmt::format("the pair with {} has expired on {}: renew it (`telehug pair renew {}` on the wearer's PC)",
                     pair.name, date(expires), pair.id);
}

nlohmann::json pair_json(const Pair& pair) {
  return {{"id", pair.id}, {"name", pair.name}, {"phrase", pair.phrase}, {"expires", date(present(pair).expires)}};
}

std::optional<nlohmann::json> pair_end_problem(const Pair& as_read, WallTime now) {
  if (now + end_is_near < as_read.expires) return {};
  const Pair pair = present(as_read);
  if (now + end_is_near < pair.expires) return {};
  return problem_json(fmt::format("the pair with {} ends on {}", pair.name, date(pair.expires)),
                      pair.side == Side::active
                          ? "it is renewed by itself when both PCs are connected, or run `telehug pair renew` on the "
                            "wearer's PC and take its text here by `telehug pair finish`"
                          : fmt::format("run `telehug pair renew {}` and do what it says", pair.id));
}

std::string describe(const Membership& membership) {
  if (!membership.pair) {
    return "not paired: only a peer on this PC is heard; `telehug pair --help` says how to pair it with another one";
  }
  return fmt::format("paired with {} until {}{}", membership.pair->name, date(membership.pair->expires),
                     membership.dds.loopback_only ? "; only on this PC (peer.loopback_only)" : "");
}

}  // namespace telehug
