// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace telehug {

// What tshark sees in one frame of a capture. A datagram in several frames is told with the one that completes it.
struct Dissection {
  std::size_t whole_in = 0;  // index of the frame that completes its datagram, which may be this one
  bool rtps = false;
  std::string source;                    // IPv4 address
  std::string info;                      // all of it in a line
  std::vector<std::string> submessages;  // as tshark names them: INFO_TS, DATA(w), DATA -> TOPIC
  std::vector<std::string> writers;      // their entity ids: 0x000100c2
  std::vector<std::string> topics;       // of the readers and writers that it announces
  std::vector<std::string> types;
  std::vector<std::string> partitions;
};

// One for each frame, in order. Throws std::runtime_error if tshark is missing or fails.
[[nodiscard]] std::vector<Dissection> dissect(const std::filesystem::path& capture);

}  // namespace telehug
