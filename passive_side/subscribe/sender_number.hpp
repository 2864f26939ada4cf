// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace telehug {

// Those who touch one jacket are told apart by numbers, 0 to max_senders - 1: one for each connection of the daemon,
// and the last for the wearer, who tries the jacket.
inline constexpr std::size_t max_senders = 9;
using SenderNumber = std::uint8_t;
inline constexpr SenderNumber wearers_number = max_senders - 1;

// The smallest that no connection has; nothing if all are taken.
[[nodiscard]] inline std::optional<SenderNumber> free_sender_number(std::span<const SenderNumber> taken) noexcept {
  for (SenderNumber number = 0; number < wearers_number; ++number)
    if (std::ranges::find(taken, number) == taken.end()) return number;
  return std::nullopt;
}

}  // namespace telehug
