// SPDX-License-Identifier: Apache-2.0
#include "link/frame_codec.hpp"

#include <boost/crc.hpp>

#include "link/cobs.hpp"

namespace telehug {
namespace {

using Packet = boost::container::static_vector<std::uint8_t, protocol::decoded_max_bytes>;

constexpr std::size_t shortest_packet = protocol::header_bytes + protocol::crc_bytes;

std::uint16_t u16_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
}

}  // namespace

std::uint16_t frame_crc(std::span<const std::uint8_t> bytes) {
  boost::crc_optimal<16, 0x1021, protocol::crc_initial, 0, false, false> crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

EncodedFrame encode(const Frame& frame) {
  Packet packet{static_cast<std::uint8_t>(frame.type), frame.sequence};
  packet.insert(packet.end(), frame.payload.begin(), frame.payload.end());
  const std::uint16_t crc = frame_crc({packet.data(), packet.size()});
  packet.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  packet.push_back(static_cast<std::uint8_t>(crc >> 8));

  EncodedFrame encoded(packet.size() + 2, 0);  // one byte of overhead and the delimiter
  cobs::encode(packet.data(), static_cast<std::uint8_t>(packet.size()), encoded.data());
  return encoded;
}

std::optional<Frame> FrameDecoder::push(std::uint8_t byte) {
  if (byte == 0) return finish();
  if (buffer_.size() == buffer_.capacity()) {
    oversize_ = true;
  } else {
    buffer_.push_back(byte);
  }
  return std::nullopt;
}

void FrameDecoder::reset() {
  buffer_.clear();
  oversize_ = false;
}

std::optional<Frame> FrameDecoder::finish() {
  if (buffer_.empty()) return std::nullopt;  // a lone delimiter flushes the line; it is not a frame
  const std::size_t length = oversize_ ? 0 : cobs::decode(buffer_.data(), static_cast<std::uint8_t>(buffer_.size()));
  const std::span<const std::uint8_t> packet(buffer_.data(), length);
  std::optional<Frame> frame;
  if (length >= shortest_packet) {
    const auto covered = packet.first(length - protocol::crc_bytes);
    if (frame_crc(covered) == u16_at(packet, covered.size())) {
      frame.emplace();
      frame->type = static_cast<protocol::FrameType>(packet[0]);
      frame->sequence = packet[1];
      frame->payload.assign(covered.begin() + protocol::header_bytes, covered.end());
    }
  }
  if (!frame) ++malformed_;
  reset();
  return frame;
}

std::optional<protocol::Caps> parse_caps(const Frame& frame) {
  const std::span<const std::uint8_t> p(frame.payload.data(), frame.payload.size());
  if (frame.type != protocol::FrameType::caps || p.size() != protocol::caps_bytes) return std::nullopt;
  return protocol::Caps{p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], p[9], u16_at(p, 10)};
}

std::optional<ReceivedTelemetry> parse_telemetry(const Frame& frame) {
  const std::span<const std::uint8_t> p(frame.payload.data(), frame.payload.size());
  if (frame.type != protocol::FrameType::telemetry || p.size() < protocol::telemetry_bytes) return std::nullopt;
  const std::size_t rest = p.size() - protocol::telemetry_bytes;
  if (rest % protocol::temperature_bytes != 0 || rest / protocol::temperature_bytes > protocol::heater_count) {
    return std::nullopt;
  }
  ReceivedTelemetry telemetry{{u16_at(p, 0), u16_at(p, 2), u16_at(p, 4), p[6], p[7], u16_at(p, 8), u16_at(p, 10)}, {}};
  for (std::size_t at = protocol::telemetry_bytes; at < p.size(); at += protocol::temperature_bytes) {
    telemetry.temperatures.push_back(
        {static_cast<std::int16_t>(u16_at(p, at)), static_cast<protocol::HeaterFault>(p[at + 2])});
  }
  return telemetry;
}

}  // namespace telehug
