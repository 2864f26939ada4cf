// SPDX-License-Identifier: Apache-2.0
#include "netlab/packet_mangler.hpp"

#include <algorithm>
#include <stdexcept>

namespace telehug {

PacketMangler::PacketMangler(const std::vector<CapturedPacket>& packets, std::uint16_t first_port) : random_(20261129) {
  constexpr int ports_of_a_domain = 250;
  for (const CapturedPacket& packet : packets) {
    auto content = udp_content(packet.frame);
    if (!content || content->payload.empty()) continue;
    if (content->port < first_port || content->port >= first_port + ports_of_a_domain) continue;
    truths_.push_back(std::move(content->payload));
  }
  if (truths_.empty()) throw std::invalid_argument("nothing went to that DDS domain");
}

Bytes PacketMangler::random_bytes() {
  constexpr std::size_t most = 1200;
  Bytes bytes(1 + below(most));
  std::generate(bytes.begin(), bytes.end(), [this] { return static_cast<std::uint8_t>(below(256)); });
  return bytes;
}

Bytes PacketMangler::truncated() {
  Bytes bytes = truths_[below(truths_.size())];
  bytes.resize(1 + below(bytes.size()));
  return bytes;
}

Bytes PacketMangler::turned_over() {
  Bytes bytes = truths_[below(truths_.size())];
  const std::size_t bits = 1 + below(8);
  for (std::size_t i = 0; i < bits; ++i) {
    const std::size_t bit = below(bytes.size() * 8);
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8)));
  }
  return bytes;
}

std::size_t PacketMangler::below(std::size_t end) {
  return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
}

}  // namespace telehug
