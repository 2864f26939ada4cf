// SPDX-License-Identifier: Apache-2.0
#include "dds/plain_payload.hpp"

#include <cstddef>

namespace telehug {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t encapsulation = 4;

// Reads CDR from a payload's beginning, where its alignment begins, too. After the first fault everything is one.
class CdrReader {
 public:
  CdrReader(Bytes payload, std::size_t at, bool little_endian)
      : payload_(payload), at_(at), little_endian_(little_endian), intact_(at <= payload.size()) {}

  [[nodiscard]] bool intact() const noexcept { return intact_; }
  [[nodiscard]] std::size_t at() const noexcept { return at_; }

  std::uint32_t u16() { return number(2); }
  std::uint32_t u32() {
    skip((4 - at_ % 4) % 4);
    return number(4);
  }
  void skip(std::size_t bytes) {
    intact_ = intact_ && bytes <= payload_.size() - at_;
    if (intact_) at_ += bytes;
  }
  // A string, or a sequence of octets.
  void octets() { skip(u32()); }

 private:
  std::uint32_t number(std::size_t bytes) {
    const std::size_t from = at_;
    skip(bytes);
    if (!intact_) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
      value = value << 8U | payload_[from + (little_endian_ ? bytes - 1 - i : i)];
    return value;
  }

  Bytes payload_;
  std::size_t at_;
  bool little_endian_;
  bool intact_;
};

// DDS Security 1.1, 7.2.1 to 7.2.3. A count that exceeds what is there ends at the payload's end, which is a fault.
void read_properties(CdrReader& in) {
  for (std::uint32_t left = in.u32(); left > 0 && in.intact(); --left) {
    in.octets();
    in.octets();
  }
}
void read_token(CdrReader& in) {
  in.octets();          // class_id
  read_properties(in);  // of text
  read_properties(in);  // of octets
}

std::optional<bool> is_little_endian(Bytes payload, std::uint8_t big_endian_kind) {
  if (payload.size() < encapsulation || payload[0] != 0) return {};
  if (payload[1] == big_endian_kind) return false;
  if (payload[1] == big_endian_kind + 1) return true;
  return {};
}

// RTPS 2.3, 9.6.2.2.2; DDS Security 1.1, 7.4.1.3.
enum Parameter : std::uint32_t {
  sentinel = 1,
  property_list = 0x59,
  identity_token = 0x1001,
  permissions_token = 0x1002,
  identity_status_token = 0x1006,
};

}  // namespace

std::optional<std::size_t> end_of_qos(Bytes content, bool little_endian) noexcept {
  for (CdrReader in(content, 0, little_endian); in.intact();) {
    const std::uint32_t parameter = in.u16();
    const std::uint32_t length = in.u16();
    if (in.intact() && parameter == sentinel) return in.at();
    in.skip(length);
  }
  return {};
}

bool is_bounded_announcement(Bytes payload) noexcept {
  constexpr std::uint8_t pl_cdr_be = 2;
  const auto little_endian = is_little_endian(payload, pl_cdr_be);
  if (!little_endian) return false;
  for (CdrReader in(payload, encapsulation, *little_endian); in.intact();) {
    const std::uint32_t parameter = in.u16();
    const std::uint32_t length = in.u16();
    if (in.intact() && parameter == sentinel) return true;
    const std::size_t begin = in.at();
    in.skip(length);
    if (!in.intact() || length % 4 != 0) return false;
    CdrReader value(payload.first(in.at()), begin, *little_endian);
    if (parameter == property_list) read_properties(value);
    if (parameter == identity_token || parameter == permissions_token || parameter == identity_status_token)
      read_token(value);
    if (!value.intact()) return false;
  }
  return false;
}

bool is_bounded_handshake(Bytes payload) noexcept {
  constexpr std::uint8_t cdr_be = 0;
  constexpr std::size_t identities_and_keys = 24 + 24 + 16 + 16 + 16;
  const auto little_endian = is_little_endian(payload, cdr_be);
  if (!little_endian) return false;
  CdrReader in(payload, encapsulation, *little_endian);
  in.skip(identities_and_keys);
  in.octets();  // message_class_id
  for (std::uint32_t tokens = in.u32(); tokens > 0 && in.intact(); --tokens)
    read_token(in);
  return in.intact();
}

}  // namespace telehug
