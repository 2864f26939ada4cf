// SPDX-License-Identifier: Apache-2.0
#include "network/ways_in.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <linux/if_addr.h>
#include <net/if.h>
#include <netinet/in.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>

namespace telehug {
namespace {

struct Block {
  std::uint32_t first;
  int bits;

  [[nodiscard]] bool has(std::uint32_t address) const { return (address ^ first) >> (32 - bits) == 0; }
};

constexpr Block carriers{0x64400000, 10};  // 100.64.0.0
// Which the internet does not lead to (RFC 6890).
constexpr std::array inner_blocks{Block{0x00000000, 8},  Block{0x0A000000, 8},  carriers,
                                  Block{0x7F000000, 8},  Block{0xA9FE0000, 16}, Block{0xAC100000, 12},
                                  Block{0xC0000000, 24}, Block{0xC0A80000, 16}, Block{0xC6120000, 15},
                                  Block{0xE0000000, 3}};

std::optional<std::uint32_t> ipv4(const std::string& text) {
  in_addr parsed{};
  if (inet_pton(AF_INET, text.c_str(), &parsed) != 1) return std::nullopt;
  return ntohl(parsed.s_addr);
}

// 2000::/3 is all of the internet that there is so far.
bool is_global_ipv6(const std::string& text) {
  in6_addr parsed{};
  return inet_pton(AF_INET6, text.c_str(), &parsed) == 1 && parsed.s6_addr[0] >> 5U == 1;
}

}  // namespace

WaysIn ways_in(const std::vector<std::string>& addresses) {
  WaysIn ways;
  for (const std::string& address : addresses) {
    if (const auto number = ipv4(address)) {
      bool inner = false;
      for (const Block& block : inner_blocks)
        inner = inner || block.has(*number);
      if (!inner && ways.ipv4.empty()) ways.ipv4 = address;
      ways.carrier_nat = ways.carrier_nat || carriers.has(*number);
    } else if (ways.ipv6.empty() && is_global_ipv6(address)) {
      ways.ipv6 = address;
    }
  }
  return ways;
}

std::string advice(const WaysIn& ways, const std::string& port) {
  if (!ways.ipv4.empty())
    return fmt::format(
        "This PC has an address of the internet, {}: it can be dialled there if its firewall lets UDP port "
        "{} in.",
        ways.ipv4, port);
  const std::string by_ipv6 =
      ways.ipv6.empty() ? ""
                        : fmt::format(
                              "This PC has a global IPv6 address, {}: it can be dialled there if its router lets "
                              "UDP port {} in and the other home has IPv6, too. ",
                              ways.ipv6, port);
  if (ways.carrier_nat)
    return by_ipv6 +
           "By IPv4 nobody can dial this PC, since it is behind its provider's NAT: the other PC or a hub must "
           "be the one that is dialled.";
  return by_ipv6 + fmt::format(
                       "By IPv4 it can be dialled if its router forwards UDP port {} to it, and has an address "
                       "of the internet itself: not one from 100.64.0.0 to 100.127.255.255, which are "
                       "providers' NATs.",
                       port);
}

std::vector<std::string> lasting_ipv6_addresses(const std::string& if_inet6) {
  // Lines of: 32 hexadecimal digits, interface's number, prefix, scope, flags, interface; numbers hexadecimal.
  constexpr std::size_t digits = 32;
  constexpr unsigned given_up = IFA_F_TEMPORARY | IFA_F_DEPRECATED | IFA_F_TENTATIVE;
  std::vector<std::string> addresses;
  std::istringstream lines(if_inet6);
  std::string line;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    const std::vector<std::string> fields{std::istream_iterator<std::string>(words), {}};
    unsigned flags = 0;
    if (fields.size() < 6 || fields[0].size() != digits) continue;
    std::from_chars(fields[4].data(), fields[4].data() + fields[4].size(), flags, 16);
    if ((flags & given_up) != 0) continue;
    in6_addr address{};
    for (std::size_t i = 0; i < sizeof address; ++i)
      std::from_chars(fields[0].data() + 2 * i, fields[0].data() + 2 * i + 2, address.s6_addr[i], 16);
    std::array<char, INET6_ADDRSTRLEN> text{};
    inet_ntop(AF_INET6, &address, text.data(), text.size());
    addresses.emplace_back(text.data());
  }
  return addresses;
}

std::vector<std::string> lasting_addresses() {
  std::ifstream file("/proc/net/if_inet6");
  auto addresses = lasting_ipv6_addresses({std::istreambuf_iterator<char>(file), {}});
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return addresses;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, &freeifaddrs);
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    if ((entry->ifa_flags & IFF_LOOPBACK) != 0) continue;
    sockaddr_in address{};
    std::memcpy(&address, entry->ifa_addr, sizeof address);
    std::array<char, INET_ADDRSTRLEN> text{};
    inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
    addresses.emplace_back(text.data());
  }
  return addresses;
}

}  // namespace telehug
