// SPDX-License-Identifier: Apache-2.0
//
// The host's end of the framing that protocol.hpp describes.
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <optional>
#include <span>

#include "link/protocol.hpp"

namespace telehug {

using FramePayload = boost::container::static_vector<std::uint8_t, protocol::payload_max_bytes>;
using EncodedFrame = boost::container::static_vector<std::uint8_t, protocol::encoded_max_bytes>;  // with its delimiter

struct Frame {
  protocol::FrameType type{};  // as received: may be a value that the enumeration lacks
  std::uint8_t sequence = 0;
  FramePayload payload;
};

[[nodiscard]] EncodedFrame encode(const Frame& frame);

// CRC-16/CCITT-FALSE; of "123456789" it is 0x29B1.
[[nodiscard]] std::uint16_t frame_crc(std::span<const std::uint8_t> bytes);

// Finds frames in a stream of bytes, which may begin anywhere and hold anything.
class FrameDecoder {
 public:
  // The frame that this byte completes.
  std::optional<Frame> push(std::uint8_t byte);
  // Forgets what it has of a frame.
  void reset();

  // Pieces between two delimiters that were no frame: too long, bad COBS or bad CRC.
  [[nodiscard]] std::uint64_t malformed() const { return malformed_; }

 private:
  std::optional<Frame> finish();

  boost::container::static_vector<std::uint8_t, protocol::encoded_max_bytes - 1> buffer_;
  bool oversize_ = false;
  std::uint64_t malformed_ = 0;
};

struct Temperature {
  std::int16_t decidegrees = protocol::no_temperature;
  protocol::HeaterFault fault{};  // as received: may be a value that the enumeration lacks
};

struct ReceivedTelemetry : protocol::Telemetry {
  boost::container::static_vector<Temperature, protocol::heater_count> temperatures;
};

// Empty if type or length of the frame is another.
[[nodiscard]] std::optional<protocol::Caps> parse_caps(const Frame& frame);
[[nodiscard]] std::optional<ReceivedTelemetry> parse_telemetry(const Frame& frame);

}  // namespace telehug
