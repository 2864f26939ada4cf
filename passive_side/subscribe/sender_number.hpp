// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace telehug {

// Those who touch one jacket are told apart by numbers, 0 to max_senders - 1: one for each connection of the daemon.
inline constexpr std::size_t max_senders = 8;
using SenderNumber = std::uint8_t;

}  // namespace telehug
