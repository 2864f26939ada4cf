// SPDX-License-Identifier: Apache-2.0
//
// The payloads that reach Fast DDS unencrypted, read before it reads them: it reserves as much as a count in them asks
// for, gigabytes if a stranger says so (CVE-2025-62599 to -62603). Only for this room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace telehug {

// Where inline QoS (RTPS 2.3, 9.4.2.11) ends that stands at the beginning; nothing if it does not end.
[[nodiscard]] std::optional<std::size_t> end_of_qos(std::span<const std::uint8_t> content, bool little_endian) noexcept;

// Of an announcement (SPDP, RTPS 2.3, 9.6.2.2): is it a list of parameters in which no length or count exceeds what it
// holds?
[[nodiscard]] bool is_bounded_announcement(std::span<const std::uint8_t> payload) noexcept;

// Of a message of the handshake (DDS Security 1.1, 7.4.3.3): does no length or count in it exceed what it holds?
[[nodiscard]] bool is_bounded_handshake(std::span<const std::uint8_t> payload) noexcept;

}  // namespace telehug
