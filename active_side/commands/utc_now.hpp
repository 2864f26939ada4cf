// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <ctime>
#include <string>

namespace telehug {

// ISO 8601, as calibrations and reports are dated.
inline std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, sizeof "2026-01-01T00:00:00Z"> text{};
  (void)std::strftime(text.data(), text.size(), "%FT%TZ", &utc);
  return text.data();
}

}  // namespace telehug
