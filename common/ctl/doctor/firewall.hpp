// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace telehug {

enum class FirewallVerdict : std::uint8_t {
  lets_in,
  lets_some_in,  // it depends on what is not known here: the sender's address, a rule that only iptables understands
  keeps_out,
};

// What nftables' rules (`nft -j list ruleset`, libnftables-json(5)) do with the first datagram from another PC to this
// UDP port: the chains of the input hook, in the order of their priorities, through jumps, sets and verdict maps.
[[nodiscard]] FirewallVerdict judge_firewall(const nlohmann::json& ruleset, int udp_port);

// The chain of the input hook that keeps it out: an accept anywhere else opens nothing.
struct ClosingChain {
  std::string family;
  std::string table;
  std::string name;
  bool of_ufw = false;
};
[[nodiscard]] std::optional<ClosingChain> closing_chain(const nlohmann::json& ruleset, int udp_port);

// What lets these UDP ports in from `sender`, by the tool that made the chain: ufw(8), firewalld(1), else nft(8).
[[nodiscard]] std::string opening_command(const ClosingChain& chain, const std::string& sender, int first_port,
                                          int last_port);

}  // namespace telehug
