// SPDX-License-Identifier: Apache-2.0
//
// Sums over small blocks of pixels, as loops that the compiler turns into SIMD: downwards byte by byte, then sideways
// for every pixel, of which only every `Width`th is wanted. That is quicker than to add what is wanted alone.
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/simd.hpp"

namespace telehug {

constexpr std::size_t bytes_of_pixel = 3;

// Writes to `sums`, for each of `count` bytes, the sum of it and those below it in `rows` rows that lie `row_bytes`
// apart. At most 257 rows.
TELEHUG_INLINE void add_rows(const std::uint8_t* pixels, std::size_t row_bytes, int rows, std::size_t count,
                             unsigned short* sums) {
  for (std::size_t k = 0; k < count; ++k) {
    unsigned sum = 0;
    for (int i = 0; i < rows; ++i)
      sum += pixels[static_cast<std::size_t>(i) * row_bytes + k];
    sums[k] = static_cast<unsigned short>(sum);
  }
}

// Adds to each sum those of the next Width - 1 pixels; the last Width - 1 pixels of `count` sums are left as they are.
// The results must fit: Width times the rows that were added is at most 257.
template <int Width>
TELEHUG_INLINE void add_next_pixels(std::size_t count, unsigned short* sums) {
  constexpr std::size_t reach = bytes_of_pixel * (Width - 1);
  for (std::size_t k = 0; k + reach < count; ++k) {
    unsigned sum = 0;
    for (std::size_t i = 0; i <= reach; i += bytes_of_pixel)
      sum += sums[k + i];
    sums[k] = static_cast<unsigned short>(sum);
  }
}

}  // namespace telehug
