// SPDX-License-Identifier: Apache-2.0
#include "netlab/captured_packet.hpp"

#include <net/ethernet.h>
#include <netinet/icmp6.h>
#include <netinet/in.h>

#include <cstddef>

namespace telehug {
namespace {

std::uint16_t big_endian(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8U | bytes[at + 1]);
}

}  // namespace

bool seeks_neighbours(const Bytes& frame) {
  constexpr std::size_t next_header = ETH_HLEN + 6;
  constexpr std::size_t kind = ETH_HLEN + 40;
  if (frame.size() < ETH_HLEN) return false;
  if (big_endian(frame, 12) == ETHERTYPE_ARP) return true;
  return big_endian(frame, 12) == ETHERTYPE_IPV6 && frame.size() > kind && frame[next_header] == IPPROTO_ICMPV6 &&
         frame[kind] >= ND_ROUTER_SOLICIT && frame[kind] <= ND_REDIRECT;
}

std::optional<UdpContent> udp_content(const Bytes& frame) {
  constexpr std::size_t ethernet = ETH_HLEN;
  constexpr std::size_t least_ip = 20;
  constexpr std::size_t udp = 8;
  constexpr std::size_t ipv6 = 40;
  if (frame.size() < ethernet + least_ip) return std::nullopt;
  std::size_t start = ethernet + ipv6;
  if (big_endian(frame, 12) == ETHERTYPE_IP) {
    const bool fragment = (big_endian(frame, ethernet + 6) & 0x3fffU) != 0;
    if (fragment || frame[ethernet + 9] != IPPROTO_UDP) return std::nullopt;
    start = ethernet + std::size_t{4} * (frame[ethernet] & 0x0fU);
  } else if (big_endian(frame, 12) != ETHERTYPE_IPV6 || frame[ethernet + 6] != IPPROTO_UDP) {
    return std::nullopt;
  }
  if (frame.size() < start + udp) return std::nullopt;
  const std::size_t length = big_endian(frame, start + 4);
  if (length < udp || frame.size() < start + length) return std::nullopt;
  const auto first = frame.begin() + static_cast<std::ptrdiff_t>(start + udp);
  return UdpContent{big_endian(frame, start + 2), big_endian(frame, start),
                    Bytes(first, first + static_cast<std::ptrdiff_t>(length - udp))};
}

}  // namespace telehug
