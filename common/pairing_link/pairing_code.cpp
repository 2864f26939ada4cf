// SPDX-License-Identifier: Apache-2.0
#include "pairing_link/pairing_code.hpp"

#include <fmt/core.h>
#include <openssl/rand.h>
#include <openssl/sha.h>

#include <algorithm>
#include <cctype>
#include <span>
#include <stdexcept>

namespace telehug {

namespace {

constexpr std::string_view alphabet = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";
constexpr std::string_view qr_prefix = "TELEHUG:PAIR:";
constexpr std::size_t group_length = 5;
constexpr std::size_t content_bytes = 16 + 4 + 2;
constexpr std::size_t checksum_bytes = 3;  // makes 25 bytes: 40 letters without a rest
constexpr std::size_t letters = (content_bytes + checksum_bytes) * 8 / 5;
constexpr std::size_t longest_text = 4 * letters;

using Bytes = std::array<std::uint8_t, content_bytes + checksum_bytes>;

void write_checksum(const Bytes& bytes, std::span<std::uint8_t, checksum_bytes> checksum) {
  std::array<std::uint8_t, SHA256_DIGEST_LENGTH> digest{};
  SHA256(bytes.data(), content_bytes, digest.data());
  std::copy_n(digest.begin(), checksum_bytes, checksum.begin());
}

char as_meant(char letter) {
  if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  if (letter == 'O') return '0';
  if (letter == 'I' || letter == 'L') return '1';
  return letter;
}

std::string_view without_qr_prefix(std::string_view text) {
  const auto upper = [](char letter) { return std::toupper(static_cast<unsigned char>(letter)); };
  const bool has_it = std::ranges::equal(text.substr(0, qr_prefix.size()), qr_prefix, {}, upper);
  return has_it ? text.substr(qr_prefix.size()) : text;
}

bool separates(char letter) {
  return letter == ' ' || letter == '-' || letter == '\t' || letter == '\r' || letter == '\n';
}

}  // namespace

PairingCode make_pairing_code(const Endpoint& inviter) {
  PairingCode code{.secret = {}, .inviter = inviter};
  if (RAND_bytes(code.secret.data(), static_cast<int>(code.secret.size())) != 1)
    throw std::runtime_error("no random numbers for a pairing code: the system has none to give");
  return code;
}

std::string to_text(const PairingCode& code) {
  Bytes bytes{};
  auto next = std::copy(code.secret.begin(), code.secret.end(), bytes.begin());
  next = std::copy(code.inviter.address.begin(), code.inviter.address.end(), next);
  *next++ = static_cast<std::uint8_t>(code.inviter.port >> 8);
  *next = static_cast<std::uint8_t>(code.inviter.port & 0xff);
  write_checksum(bytes, std::span(bytes).last<checksum_bytes>());

  std::string text;
  for (std::size_t letter = 0; letter < letters; ++letter) {
    if (letter > 0 && letter % group_length == 0) text += '-';
    unsigned value = 0;
    for (std::size_t bit = letter * 5; bit < letter * 5 + 5; ++bit)
      value = value << 1U | (static_cast<unsigned>(bytes[bit / 8]) >> (7U - bit % 8) & 1U);
    text += alphabet[value];
  }
  return text;
}

std::string to_qr_text(const PairingCode& code) {
  return std::string(qr_prefix) + to_text(code);
}

Result<PairingCode> parse_pairing_code(std::string_view text) {
  text = without_qr_prefix(text);
  if (text.size() > longest_text)
    return Error{fmt::format("a pairing code has {} letters and digits; this is longer", letters)};
  Bytes bytes{};
  std::size_t letter = 0;
  for (const char written : text) {
    if (separates(written)) continue;
    const auto value = alphabet.find(as_meant(written));
    if (value == std::string_view::npos)
      return Error{
          fmt::format("the pairing code has a wrong character at its letter {}: it consists of digits and "
                      "letters without U",
                      letter + 1)};
    if (letter == letters)
      return Error{fmt::format("a pairing code has {} letters and digits; this has more", letters)};
    for (std::size_t i = 0; i < 5; ++i) {
      const std::size_t bit = letter * 5 + i;
      if ((value >> (4 - i) & 1U) != 0) bytes[bit / 8] |= static_cast<std::uint8_t>(1U << (7 - bit % 8));
    }
    ++letter;
  }
  if (letter != letters)
    return Error{fmt::format("a pairing code has {} letters and digits; this has {}", letters, letter)};

  std::array<std::uint8_t, checksum_bytes> checksum{};
  write_checksum(bytes, checksum);
  if (!std::equal(checksum.begin(), checksum.end(), bytes.begin() + content_bytes))
    return Error{"the pairing code has a typing error: compare it letter by letter"};

  PairingCode code;
  std::copy_n(bytes.begin(), 16, code.secret.begin());
  std::copy_n(bytes.begin() + 16, 4, code.inviter.address.begin());
  code.inviter.port = static_cast<std::uint16_t>(bytes[20] << 8 | bytes[21]);
  if (code.inviter.port == 0) return Error{"the pairing code names no port: ask for a new one"};
  return code;
}

std::string to_text(const Endpoint& endpoint) {
  const auto& a = endpoint.address;
  return fmt::format("{}.{}.{}.{}:{}", a[0], a[1], a[2], a[3], endpoint.port);
}

}  // namespace telehug
