// SPDX-License-Identifier: Apache-2.0
//
// Can another home dial this PC? Its own addresses tell a part of that; what its router is behind, they don't.
#pragma once

#include <string>
#include <vector>

namespace telehug {

struct WaysIn {
  std::string ipv4;          // an address of the internet that this PC itself has; empty: none
  std::string ipv6;          // likewise
  bool carrier_nat = false;  // of 100.64.0.0/10 (RFC 6598): what this PC is connected to is its provider's NAT
};

// IPv4 and IPv6 addresses as inet_pton(3) reads them; others count for nothing.
[[nodiscard]] WaysIn ways_in(const std::vector<std::string>& addresses);

// What that means for whoever wants this PC to be dialled at that UDP port: a sentence or two.
[[nodiscard]] std::string advice(const WaysIn& ways, const std::string& port);

// Of all interfaces of this PC but loopback; without IPv6 addresses that are given up after a while (RFC 8981).
[[nodiscard]] std::vector<std::string> lasting_addresses();

// The IPv6 ones, as /proc/net/if_inet6 lists them.
[[nodiscard]] std::vector<std::string> lasting_ipv6_addresses(const std::string& if_inet6);

}  // namespace telehug
