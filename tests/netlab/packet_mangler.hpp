// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <vector>

#include "netlab/captured_packet.hpp"

namespace telehug {

// Payloads that nobody should send: from a fixed seed, and from what was really sent.
class PacketMangler {
 public:
  // Takes what went to a DDS domain, whose ports are 250 from `first_port` on. Throws std::invalid_argument if that is
  // nothing.
  PacketMangler(const std::vector<CapturedPacket>& packets, std::uint16_t first_port);

  [[nodiscard]] Bytes random_bytes();
  // A beginning of a real one.
  [[nodiscard]] Bytes truncated();
  // A real one in which up to eight bits are the other way about.
  [[nodiscard]] Bytes turned_over();

 private:
  [[nodiscard]] std::size_t below(std::size_t end);

  std::mt19937 random_;
  std::vector<Bytes> truths_;
};

}  // namespace telehug
