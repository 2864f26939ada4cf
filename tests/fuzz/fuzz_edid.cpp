// SPDX-License-Identifier: Apache-2.0
//
// What a monitor says of itself. The checksum is put right, which no guessing would be.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "screen_x11/edid.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> edid(data, data + size);
  (void)telehug::monitor_size_in_edid(edid);
  if (size < 128) return 0;
  constexpr std::uint8_t header[] = {0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0};
  std::ranges::copy(header, edid.begin());
  edid[127] = 0;
  edid[127] = static_cast<std::uint8_t>(256 - std::accumulate(edid.begin(), edid.begin() + 128, 0U) % 256);
  const auto mm = telehug::monitor_size_in_edid(edid);
  if (mm && (mm->width_mm < 90 || mm->width_mm > 3000 || mm->height_mm < 90 || mm->height_mm > 3000)) std::abort();
  return 0;
}
