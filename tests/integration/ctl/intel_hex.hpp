// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

namespace telehug {

// What an Intel hex file below 64 KiB puts where: the data records, byte by byte.
inline std::map<std::uint32_t, std::uint8_t> read_intel_hex(const std::filesystem::path& file) {
  std::map<std::uint32_t, std::uint8_t> bytes;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const auto number = [&line](std::size_t at, std::size_t digits) {
      return static_cast<std::uint32_t>(std::stoul(line.substr(at, digits), nullptr, 16));
    };
    if (line.size() < 11 || line[0] != ':') throw std::runtime_error(file.string() + " is no Intel hex file");
    if (number(7, 2) != 0) continue;
    const std::uint32_t count = number(1, 2);
    for (std::uint32_t i = 0; i < count; ++i)
      bytes[number(3, 4) + i] = static_cast<std::uint8_t>(number(9 + 2 * std::size_t{i}, 2));
  }
  if (bytes.empty()) throw std::runtime_error("nothing can be read from " + file.string() + "; run deploy/setup test");
  return bytes;
}

}  // namespace telehug
