// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "netlab/captured_packet.hpp"

namespace telehug {

// Ethernet frames as a file that tshark and Wireshark read. Its times count from the start of this PC. Throws
// std::runtime_error if it can't be written.
void write_pcap(const std::filesystem::path& file, const std::vector<CapturedPacket>& packets);

}  // namespace telehug
