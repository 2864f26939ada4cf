// SPDX-License-Identifier: Apache-2.0
#include "dds/message_filter.hpp"

#include <cstddef>
#include <optional>

#include "dds/plain_payload.hpp"

namespace telehug {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t message_header = 20;
constexpr std::size_t submessage_header = 4;
constexpr std::size_t secure_header = 20;  // content of SEC_PREFIX (DDS Security 1.1, 7.3.6.2)

// RTPS 2.3, 9.4.5.1.1; DDS Security 1.1, 7.3.6.
enum Kind : std::uint8_t {
  pad = 0x01,
  info_ts = 0x09,
  info_dst = 0x0e,
  data = 0x15,
  sec_body = 0x30,
  sec_prefix = 0x31,
  sec_postfix = 0x32,
  srtps_prefix = 0x33,
  first_of_vendors = 0x80,  // unknown ones are skipped by everybody
};

constexpr std::uint32_t none = 0;
constexpr std::uint32_t participant_writer = 0x000100c2;
constexpr std::uint32_t participant_reader = 0x000100c7;
constexpr std::uint32_t handshake_writer = 0x000201c3;
constexpr std::uint32_t handshake_reader = 0x000201c4;

struct Submessage {
  std::uint8_t kind = 0;
  std::uint8_t flags = 0;
  Bytes content;
  std::size_t end = 0;  // in the message; the next one's beginning
};

std::optional<Submessage> submessage_at(Bytes message, std::size_t at) {
  if (message.size() - at < submessage_header) return {};
  const std::uint8_t kind = message[at];
  const bool little_endian = (message[at + 1] & 1U) != 0;
  const std::size_t low = message[at + (little_endian ? 2 : 3)];
  const std::size_t length = low | static_cast<std::size_t>(message[at + (little_endian ? 3 : 2)]) << 8U;
  // Of the other kinds that would mean "until the end".
  if (length == 0 && kind != info_ts && kind != pad) return {};
  const std::size_t begin = at + submessage_header;
  if (message.size() - begin < length) return {};
  return Submessage{kind, message[at + 1], message.subspan(begin, length), begin + (length + 3) / 4 * 4};
}

std::uint32_t entity(Bytes bytes) {
  return static_cast<std::uint32_t>(bytes[0]) << 24U | static_cast<std::uint32_t>(bytes[1]) << 16U |
         static_cast<std::uint32_t>(bytes[2]) << 8U | bytes[3];
}

// RTPS 2.3, 9.4.5.3: what stands behind the header and the inline QoS, if there is any.
std::optional<Bytes> payload_of(const Submessage& data) {
  constexpr std::uint8_t little_endian = 0x01;
  constexpr std::uint8_t has_qos = 0x02;
  constexpr std::size_t header = 20;
  const bool usual_header = data.content.size() > header && data.content[2 + (data.flags & 1U ? 0 : 1)] == 16 &&
                            data.content[2 + (data.flags & 1U ? 1 : 0)] == 0;
  if (!usual_header) return {};
  const Bytes content = data.content.subspan(header);
  if ((data.flags & has_qos) == 0) return content;
  const auto end = end_of_qos(content, (data.flags & little_endian) != 0);
  if (!end) return {};
  return content.subspan(*end);
}

bool may_be_plain_data(const Submessage& submessage) {
  constexpr std::uint8_t has_data = 0x04;  // otherwise a key alone: somebody leaves
  const auto payload = payload_of(submessage);
  if (!payload) return false;
  const std::uint32_t reader = entity(submessage.content.subspan(4, 4));
  const std::uint32_t writer = entity(submessage.content.subspan(8, 4));
  if (writer == participant_writer && (reader == none || reader == participant_reader))
    return (submessage.flags & has_data) == 0 || is_bounded_announcement(*payload);
  return writer == handshake_writer && (reader == none || reader == handshake_reader) && is_bounded_handshake(*payload);
}

bool may_be_plain(const Submessage& submessage) {
  switch (submessage.kind) {
    case pad:
    case info_ts:
    case info_dst:
      return true;
    case data:
      return may_be_plain_data(submessage);
    default:
      return submessage.kind >= first_of_vendors;
  }
}

// Prefix, body and postfix, as which Fast DDS reads them: it refuses them unless they were made with the peer's key.
std::optional<std::size_t> end_of_secured(Bytes message, const Submessage& prefix) {
  if (prefix.content.size() != secure_header || prefix.end >= message.size()) return {};
  const auto body = submessage_at(message, prefix.end);
  if (!body || body->kind != sec_body || body->end >= message.size()) return {};
  const auto postfix = submessage_at(message, body->end);
  if (!postfix || postfix->kind != sec_postfix) return {};
  return postfix->end;
}

}  // namespace

bool may_pass(Bytes message) noexcept {
  if (message.size() <= message_header) return false;
  // What follows the encrypted part is not read.
  if (message[message_header] == srtps_prefix) return true;
  for (std::size_t at = message_header; at < message.size();) {
    const auto submessage = submessage_at(message, at);
    if (!submessage) return false;
    if (submessage->kind == sec_prefix) {
      const auto end = end_of_secured(message, *submessage);
      if (!end) return false;
      at = *end;
    } else if (may_be_plain(*submessage)) {
      at = submessage->end;
    } else {
      return false;
    }
  }
  return true;
}

}  // namespace telehug
