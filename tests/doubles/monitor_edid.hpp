// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace telehug {

// What a monitor of this size says of itself: the first block of an EDID, with nothing in it but the sizes.
// `timing_mm`: as the preferred timing tells it; 0 x 0: there is no timing.
inline std::vector<std::uint8_t> monitor_edid(std::pair<int, int> cm, std::pair<int, int> timing_mm) {
  std::vector<std::uint8_t> block(128);
  constexpr std::array<std::uint8_t, 8> header{0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0};
  std::ranges::copy(header, block.begin());
  block[21] = static_cast<std::uint8_t>(cm.first);
  block[22] = static_cast<std::uint8_t>(cm.second);
  if (timing_mm.first > 0) {
    block[54] = 0x02;
    block[55] = 0x3A;
    block[66] = static_cast<std::uint8_t>(timing_mm.first & 0xFF);
    block[67] = static_cast<std::uint8_t>(timing_mm.second & 0xFF);
    block[68] = static_cast<std::uint8_t>(((timing_mm.first >> 8) << 4) | (timing_mm.second >> 8));
  }
  const auto sum = std::accumulate(block.begin(), block.end(), 0U);
  block[127] = static_cast<std::uint8_t>(256 - sum % 256);
  return block;
}

}  // namespace telehug
