// SPDX-License-Identifier: Apache-2.0
#include "netlab/pcap_file.hpp"

#include <array>
#include <fstream>
#include <stdexcept>

namespace telehug {
namespace {

// draft-ietf-opsawg-pcap; all numbers in the writer's own order of bytes, which the first one tells.
constexpr std::uint32_t magic_with_nanoseconds = 0xA1B23C4D;
constexpr std::uint32_t version_2_4 = 2 | 4U << 16U;
constexpr std::uint32_t longest_packet = 65536;
constexpr std::uint32_t ethernet = 1;
constexpr std::int64_t ns_per_s = 1'000'000'000;

template <std::size_t count>
void write(std::ofstream& file, const std::array<std::uint32_t, count>& numbers) {
  file.write(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
}

}  // namespace

void write_pcap(const std::filesystem::path& file, const std::vector<CapturedPacket>& packets) {
  std::ofstream out(file, std::ios::binary);
  write<6>(out, {magic_with_nanoseconds, version_2_4, 0, 0, longest_packet, ethernet});
  for (const CapturedPacket& packet : packets) {
    const std::int64_t arrived_ns = to_ns(packet.arrived);
    const auto size = static_cast<std::uint32_t>(packet.frame.size());
    write<4>(out, {static_cast<std::uint32_t>(arrived_ns / ns_per_s), static_cast<std::uint32_t>(arrived_ns % ns_per_s),
                   size, size});
    out.write(reinterpret_cast<const char*>(packet.frame.data()), size);
  }
  if (!out.flush()) throw std::runtime_error("the packets can't be written to " + file.string());
}

}  // namespace telehug
