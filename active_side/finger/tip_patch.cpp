// SPDX-License-Identifier: Apache-2.0
#include "finger/tip_patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "common/simd.hpp"

namespace telehug {
namespace {

constexpr std::size_t most_columns = 256;

struct Neighbours {
  int first = 0;
  int second = 0;
  float share = 0;  // of the second
};

Neighbours neighbours(double at, int count) {
  const double floor = std::floor(at);
  const int first = static_cast<int>(floor);
  return {std::clamp(first, 0, count - 1), std::clamp(first + 1, 0, count - 1), static_cast<float>(at - floor)};
}

}  // namespace

TELEHUG_SIMD void sample_patch(const cv::Mat& bgr, const PatchPlace& place, float* values) {
  std::array<Neighbours, most_columns> across{};
  for (int column = 0; column < place.columns; ++column)
    across[static_cast<std::size_t>(column)] = neighbours(place.picture_point(column, 0).u_px, bgr.cols);
  for (int row = 0; row < place.rows; ++row) {
    const Neighbours down = neighbours(place.picture_point(0, row).v_px, bgr.rows);
    const auto* const upper = bgr.ptr<std::uint8_t>(down.first);
    const auto* const lower = bgr.ptr<std::uint8_t>(down.second);
    for (int column = 0; column < place.columns; ++column) {
      const Neighbours& side = across[static_cast<std::size_t>(column)];
      for (int k = 0; k < 3; ++k, ++values) {
        const auto mixed = [&](const std::uint8_t* line) {
          const auto first = static_cast<float>(line[3 * side.first + k]);
          return first + side.share * (static_cast<float>(line[3 * side.second + k]) - first);
        };
        const float above = mixed(upper);
        *values = (above + down.share * (mixed(lower) - above)) / 127.5F - 1;
      }
    }
  }
}

}  // namespace telehug
