// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace telehug {

// May this RTPS message reach a paired side's Fast DDS? One that is encrypted as a whole, and what can't be: who is
// there (SPDP), the handshake, and the exchange of keys, which is encrypted part by part. Fast DDS 2.9 would take
// everything else as well, in anybody's name, although rtps_protection_kind is ENCRYPT: touches, heartbeats, even keys.
// Nor may a stranger make Fast DDS reserve gigabytes. A message that Fast DDS might read otherwise than this does is
// refused.
[[nodiscard]] bool may_pass(std::span<const std::uint8_t> message) noexcept;

}  // namespace telehug
