// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace telehug {

// A Bluetooth device with a serial port (RFCOMM).
struct RfcommPeer {
  std::array<std::uint8_t, 6> address{};  // as it is written: the first pair of digits first
  std::optional<std::uint8_t> channel;    // 1..30; empty: to be looked up
};

// "AA:BB:CC:DD:EE:FF" or "AA:BB:CC:DD:EE:FF/CHANNEL"; empty if it is neither.
[[nodiscard]] inline std::optional<RfcommPeer> parse_rfcomm_peer(std::string_view text) {
  constexpr std::size_t address_length = 17;
  constexpr int last_channel = 30;
  RfcommPeer peer;
  if (text.size() < address_length) return std::nullopt;
  for (std::size_t i = 0; i < peer.address.size(); ++i) {
    const char* digits = text.data() + 3 * i;
    const auto [end, error] = std::from_chars(digits, digits + 2, peer.address.at(i), 16);
    if (error != std::errc() || end != digits + 2) return std::nullopt;
    if (i + 1 < peer.address.size() && *end != ':') return std::nullopt;
  }
  if (text.size() == address_length) return peer;
  const std::string_view number = text.substr(address_length + 1);
  int channel = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), channel);
  const bool is_number = error == std::errc() && end == number.data() + number.size() && number.front() != '-';
  if (text[address_length] != '/' || !is_number || channel < 1 || channel > last_channel) return std::nullopt;
  peer.channel = static_cast<std::uint8_t>(channel);
  return peer;
}

// "AA:BB:CC:DD:EE:FF"
[[nodiscard]] inline std::string address_text(const RfcommPeer& peer) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string text;
  for (const std::uint8_t byte : peer.address) {
    if (!text.empty()) text += ':';
    text += digits[byte >> 4U];
    text += digits[byte & 15U];
  }
  return text;
}

}  // namespace telehug
