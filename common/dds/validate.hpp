// SPDX-License-Identifier: Apache-2.0
//
// What a message must fulfil before anything acts on it. Fast DDS checks neither bounds, enums nor numbers on receipt.
#pragma once

#include "common/messages.hpp"

namespace telehug {

// Limits that no rig reaches; what lies beyond is a fault or an attack.
inline constexpr double max_screen_mm = 10'000;
inline constexpr double max_body_fh = 100;
inline constexpr double max_speed_mm_s = 100'000;
inline constexpr std::uint16_t max_grid_boxes_per_side = 100;

// What is wrong, as a literal that completes "the message was dropped: ..."; null if nothing is.
using Fault = const char*;

[[nodiscard]] Fault validate(const TouchEvent& event) noexcept;
[[nodiscard]] Fault validate(const Felt& felt) noexcept;
[[nodiscard]] Fault validate(const Heartbeat& heartbeat) noexcept;
[[nodiscard]] Fault validate(const SideStatus& status) noexcept;
[[nodiscard]] Fault validate(const StopAll& stop) noexcept;
[[nodiscard]] Fault validate(const PairRenewal& renewal) noexcept;
[[nodiscard]] Fault validate(const Hug& hug) noexcept;

}  // namespace telehug
