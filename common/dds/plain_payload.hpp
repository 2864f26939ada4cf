// SPDX-License-Identifier: Apache-2.0
//
// The payloads that reach Fast DDS unencrypted, read before it reads them: it reserves as much as a count in them asks
// for, gigabytes if a stranger says so (CVE-2025-62599 to -62603). Only for this room.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace telehug {

using GuidPrefix = std::array<std::uint8_t, 12>;

// Where inline QoS (RTPS 2.3, 9.4.2.11) ends that stands at the beginning, if it says nothing but to what the sample is
// an answer; Fast DDS adds that now and then. Nothing if it says more, such as that somebody has left
// (PID_STATUS_INFO).
[[nodiscard]] std::optional<std::size_t> end_of_harmless_qos(std::span<const std::uint8_t> content,
                                                             bool little_endian) noexcept;

// Of an announcement (SPDP, RTPS 2.3, 9.6.2.2): whose it is. Nothing if it does not say so exactly once, if a length or
// count in it exceeds what it holds, or if it is no list of parameters.
[[nodiscard]] std::optional<GuidPrefix> announcer(std::span<const std::uint8_t> payload) noexcept;

// Of a message of the handshake (DDS Security 1.1, 7.4.3.3): does no length or count in it exceed what it holds?
[[nodiscard]] bool is_bounded_handshake(std::span<const std::uint8_t> payload) noexcept;

}  // namespace telehug
