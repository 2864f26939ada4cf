// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/clock.hpp"

namespace telehug {

using Bytes = std::vector<std::uint8_t>;

// A frame as it was on the wire.
struct CapturedPacket {
  Timestamp arrived;
  Bytes frame;
};

struct UdpContent {
  std::uint16_t port = 0;  // where it goes
  std::uint16_t from_port = 0;
  Bytes payload;
};

// Nothing if the Ethernet frame holds no whole UDP datagram.
[[nodiscard]] std::optional<UdpContent> udp_content(const Bytes& frame);
// ARP, and what does the same for IPv6.
[[nodiscard]] bool seeks_neighbours(const Bytes& frame);

}  // namespace telehug
