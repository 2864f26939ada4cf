// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

namespace telehug {

enum class FirewallVerdict : std::uint8_t {
  lets_in,
  lets_some_in,  // it depends on what is not known here: the sender's address, a rule that only iptables understands
  keeps_out,
};

// What nftables' rules (`nft -j list ruleset`, libnftables-json(5)) do with the first datagram from another PC to this
// UDP port: the chains of the input hook, in the order of their priorities, through jumps, sets and verdict maps.
[[nodiscard]] FirewallVerdict judge_firewall(const nlohmann::json& ruleset, int udp_port);

}  // namespace telehug
