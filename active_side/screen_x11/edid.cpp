// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/edid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace telehug {
namespace {

constexpr std::size_t block_bytes = 128;
constexpr std::array<std::uint8_t, 8> header{0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0};
constexpr std::size_t width_cm_at = 21;
constexpr std::size_t height_cm_at = 22;
constexpr std::size_t timing_at = 54;  // the first detailed timing; a pixel clock of 0: something else is there
constexpr double least_mm = 100;
constexpr double most_mm = 3000;
constexpr double rounding_mm = 10;  // centimetres are rounded to either side

bool possible(const MonitorMm& size) {
  const auto within = [](double mm) { return mm >= least_mm && mm <= most_mm; };
  return within(size.width_mm) && within(size.height_mm);
}

bool is_edid(std::span<const std::uint8_t> block) {
  const auto sum = std::accumulate(block.begin(), block.end(), 0U);
  return std::equal(header.begin(), header.end(), block.begin()) && sum % 256 == 0;
}

MonitorMm in_whole_cm(std::span<const std::uint8_t> block) {
  return {10.0 * block[width_cm_at], 10.0 * block[height_cm_at]};
}

std::optional<MonitorMm> of_the_timing(std::span<const std::uint8_t> block) {
  const auto timing = block.subspan(timing_at, 18);
  if (timing[0] == 0 && timing[1] == 0) return std::nullopt;
  const int width_mm = timing[12] | ((timing[14] >> 4) << 8);
  const int height_mm = timing[13] | ((timing[14] & 0x0F) << 8);
  return MonitorMm{static_cast<double>(width_mm), static_cast<double>(height_mm)};
}

}  // namespace

std::optional<MonitorMm> monitor_size_in_edid(std::span<const std::uint8_t> edid) {
  if (edid.size() < block_bytes) return std::nullopt;
  const auto block = edid.first(block_bytes);
  if (!is_edid(block)) return std::nullopt;
  const MonitorMm coarse = in_whole_cm(block);
  if (!possible(coarse)) return std::nullopt;
  const auto fine = of_the_timing(block);
  const bool agrees = fine && std::abs(fine->width_mm - coarse.width_mm) <= rounding_mm &&
                      std::abs(fine->height_mm - coarse.height_mm) <= rounding_mm;
  return agrees ? *fine : coarse;
}

}  // namespace telehug
