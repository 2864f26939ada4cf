// SPDX-License-Identifier: Apache-2.0
//
// What the inviter's person tells the other person: where to dial, and a secret that nobody else knows.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace telehug {

struct Endpoint {
  std::array<std::uint8_t, 4> address{};  // IPv4, as written: 192, 168, 1, 20
  std::uint16_t port = 0;
};

struct PairingCode {
  std::array<std::uint8_t, 16> secret{};
  Endpoint inviter;
};

// With a fresh secret. Throws std::runtime_error if the system has no randomness to give.
[[nodiscard]] PairingCode make_pairing_code(const Endpoint& inviter);

// Eight groups of five letters and digits that are hard to confuse (Crockford's base 32), with a checksum.
[[nodiscard]] std::string to_text(const PairingCode& code);

// What a QR code of it holds: "TELEHUG:PAIR:" and the code, in letters that such a code stores compactly.
[[nodiscard]] std::string to_qr_text(const PairingCode& code);

// Takes it as people write it: any case, spaces and dashes anywhere, O for 0, I and L for 1; or as a QR code holds it.
[[nodiscard]] Result<PairingCode> parse_pairing_code(std::string_view text);

// "192.168.1.20:4711"
[[nodiscard]] std::string to_text(const Endpoint& endpoint);

}  // namespace telehug
