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
constexpr std::size_t channels = 3;
constexpr int line_pixels = 512;

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

// Rows are mixed first, as many pixels as the columns at hand need in one go.
TELEHUG_SIMD void sample_patch(const cv::Mat& bgr, const PatchPlace& place, float* values) {
  std::array<Neighbours, most_columns> across{};
  for (int column = 0; column < place.columns; ++column)
    across[static_cast<std::size_t>(column)] = neighbours(place.picture_point(column, 0).u_px, bgr.cols);
  std::array<float, channels * line_pixels> line;
  const int at_once = std::max(1, static_cast<int>((line_pixels - 2) / std::max(1.0, place.step_px)));
  for (int from = 0; from < place.columns; from += at_once) {
    const int end = std::min(from + at_once, place.columns);
    const Neighbours& one = across[static_cast<std::size_t>(from)];
    const Neighbours& other = across[static_cast<std::size_t>(end - 1)];
    const int left = std::min(one.first, other.first);
    const std::size_t mixed = channels * static_cast<std::size_t>(std::max(one.second, other.second) + 1 - left);
    for (int row = 0; row < place.rows; ++row) {
      const Neighbours down = neighbours(place.picture_point(0, row).v_px, bgr.rows);
      const auto* const upper = bgr.ptr<std::uint8_t>(down.first, left);
      const auto* const lower = bgr.ptr<std::uint8_t>(down.second, left);
      for (std::size_t i = 0; i < mixed; ++i) {
        const auto above = static_cast<float>(upper[i]);
        line[i] = above + down.share * (static_cast<float>(lower[i]) - above);
      }
      float* value = values + channels * static_cast<std::size_t>(row * place.columns + from);
      for (int column = from; column < end; ++column) {
        const Neighbours& side = across[static_cast<std::size_t>(column)];
        const float* const first = &line[channels * static_cast<std::size_t>(side.first - left)];
        const float* const second = &line[channels * static_cast<std::size_t>(side.second - left)];
        for (std::size_t k = 0; k < channels; ++k)
          *value++ = (first[k] + side.share * (second[k] - first[k])) / 127.5F - 1;
      }
    }
  }
}

}  // namespace telehug
