// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

namespace telehug {

// Rows `first` to `end` - 1 of a picture; by default all, however many there are.
struct RowRange {
  int first = 0;
  int end = std::numeric_limits<int>::max();

  [[nodiscard]] constexpr int count() const noexcept { return std::max(0, end - first); }
  [[nodiscard]] constexpr bool contains(int row) const noexcept { return row >= first && row < end; }
  // What of it lies in a picture of so many rows.
  [[nodiscard]] constexpr RowRange within(int height_px) const noexcept {
    const int inside = std::clamp(first, 0, height_px);
    return {inside, std::clamp(end, inside, height_px)};
  }
  // The same rows of a picture of so many rows, flipped about its middle row.
  [[nodiscard]] constexpr RowRange flipped(int height_px) const noexcept {
    const RowRange inside = within(height_px);
    return {height_px - inside.end, height_px - inside.first};
  }
  friend constexpr bool operator==(const RowRange&, const RowRange&) = default;
};

}  // namespace telehug
