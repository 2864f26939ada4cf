// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include <util/crc16.h>

#include "analog.hpp"
#include "board.hpp"
#include "heaters.hpp"
#include "link/cobs.hpp"
#include "link/protocol.hpp"
#include "motors.hpp"
#include "uart.hpp"
#include "watchdog.hpp"

namespace protocol = telehug::protocol;
namespace cobs = telehug::cobs;
using protocol::FrameType;
using protocol::NackReason;

namespace {

struct Frame {
  uint8_t type;
  uint8_t sequence;
  const uint8_t* payload;
  uint8_t length;
};

uint8_t buffer[protocol::encoded_max_bytes];
uint8_t buffered = 0;
bool oversize = false;
uint16_t frames_ok = 0;
uint16_t frames_malformed = 0;
int16_t last_sequence = -1;  // none since the reset

uint16_t crc_of(const uint8_t* bytes, uint8_t length) {
  uint16_t crc = protocol::crc_initial;
  for (uint8_t i = 0; i < length; ++i)
    crc = _crc_xmodem_update(crc, bytes[i]);
  return crc;
}

uint16_t u16_at(const uint8_t* at) {
  return at[0] | static_cast<uint16_t>(at[1] << 8);
}

void put_u16(uint8_t* at, uint16_t value) {
  at[0] = value & 0xFF;
  at[1] = value >> 8;
}

constexpr uint8_t telemetry_bytes = protocol::telemetry_bytes + board::heater_count * protocol::temperature_bytes;
constexpr uint8_t longest_answer = telemetry_bytes > protocol::caps_bytes ? telemetry_bytes : protocol::caps_bytes;

// An answer for which the ring has no room is dropped: the host asks again, the motors can't wait.
void answer(FrameType type, uint8_t sequence, const uint8_t* payload, uint8_t length) {
  constexpr uint8_t longest = protocol::header_bytes + longest_answer + protocol::crc_bytes;
  uint8_t plain[longest];
  uint8_t encoded[longest + 1];
  plain[0] = static_cast<uint8_t>(type);
  plain[1] = sequence;
  for (uint8_t i = 0; i < length; ++i)
    plain[protocol::header_bytes + i] = payload[i];
  const uint8_t covered = protocol::header_bytes + length;
  put_u16(plain + covered, crc_of(plain, covered));
  const uint8_t size = cobs::encode(plain, covered + protocol::crc_bytes, encoded);
  if (!uart::has_room(size + 1)) return;
  for (uint8_t i = 0; i < size; ++i)
    uart::write(encoded[i]);
  uart::write(0);
}

void accept(const Frame& frame) {
  answer(FrameType::ack, frame.sequence, &frame.type, 1);
}

void refuse(const Frame& frame, NackReason reason) {
  const uint8_t payload[] = {frame.type, static_cast<uint8_t>(reason)};
  answer(FrameType::nack, frame.sequence, payload, sizeof payload);
}

void on_hello(const Frame& frame) {
  if (frame.length != protocol::hello_bytes) return refuse(frame, NackReason::bad_length);
  if (frame.payload[0] > protocol::version || frame.payload[1] < protocol::version) {
    return refuse(frame, NackReason::bad_version);
  }
  motors::arm();
  const uint8_t caps[protocol::caps_bytes] = {
      protocol::version,
      TELEHUG_FIRMWARE_VERSION,
      board::motor_count,
      board::heater_count,
      board::heater_count,  // temperatures
      protocol::intensity_levels,
      protocol::encoded_max_bytes,
      protocol::keepalive_ms / 10,
      protocol::drive_max_ms / 10,
      watchdog::reset_cause(),
      frame.payload[2],
      frame.payload[3],
  };
  answer(FrameType::caps, frame.sequence, caps, sizeof caps);
}

void on_set(const Frame& frame) {
  if (frame.length == 0 || frame.length % protocol::set_entry_bytes != 0) {
    return refuse(frame, NackReason::bad_length);
  }
  for (uint8_t i = 0; i < frame.length; i += protocol::set_entry_bytes) {
    if (frame.payload[i] >= board::motor_count) return refuse(frame, NackReason::bad_channel);
  }
  motors::begin_change();
  for (uint8_t i = 0; i < frame.length; i += protocol::set_entry_bytes) {
    const uint8_t* entry = frame.payload + i;
    motors::set(entry[0], entry[1], uint16_t{entry[2]} * 10);
  }
  motors::commit_change();
  accept(frame);
}

void on_set_all(const Frame& frame) {
  if (frame.length != protocol::set_all_bytes) return refuse(frame, NackReason::bad_length);
  const uint16_t duration_ms = u16_at(frame.payload + protocol::motor_count);
  for (uint8_t channel = board::motor_count; channel < protocol::motor_count; ++channel) {
    if (frame.payload[channel] != 0) return refuse(frame, NackReason::bad_channel);
  }
  motors::begin_change();
  for (uint8_t channel = 0; channel < board::motor_count; ++channel) {
    motors::set(channel, frame.payload[channel], duration_ms);
  }
  motors::commit_change();
  accept(frame);
}

void on_heat(const Frame& frame) {
  if (board::heater_count == 0) return refuse(frame, NackReason::unknown_type);
  if (frame.length == 0 || frame.length % protocol::heat_entry_bytes != 0) {
    return refuse(frame, NackReason::bad_length);
  }
  for (uint8_t i = 0; i < frame.length; i += protocol::heat_entry_bytes) {
    const uint8_t* entry = frame.payload + i;
    const uint8_t number = entry[0] + 1;
    if (number == 0 || number > board::heater_count) return refuse(frame, NackReason::bad_channel);
    if (u16_at(entry + 1) > protocol::heat_max_decidegrees) return refuse(frame, NackReason::bad_value);
  }
  for (uint8_t i = 0; i < frame.length; i += protocol::heat_entry_bytes) {
    const uint8_t* entry = frame.payload + i;
    heaters::set(entry[0], u16_at(entry + 1), uint16_t{entry[3]} * 10);
  }
  accept(frame);
}

void on_status(const Frame& frame) {
  if (frame.length != 0) return refuse(frame, NackReason::bad_length);
  uint8_t telemetry[telemetry_bytes];
  put_u16(telemetry, frames_ok);
  put_u16(telemetry + 2, frames_malformed);
  put_u16(telemetry + 4, uart::overruns());
  telemetry[6] = watchdog::reset_cause();
  telemetry[7] = motors::armed() ? 1 : 0;
  put_u16(telemetry + 8, motors::running());
  put_u16(telemetry + 10, analog::supply_mv());
  uint8_t* at = telemetry + protocol::telemetry_bytes;
  for (uint8_t heater = 0; heater != board::heater_count; ++heater) {
    put_u16(at, static_cast<uint16_t>(heaters::temperature(heater)));
    at[2] = static_cast<uint8_t>(heaters::fault(heater));
    at += protocol::temperature_bytes;
  }
  answer(FrameType::telemetry, frame.sequence, telemetry, sizeof telemetry);
}

void act_on(const Frame& frame) {
  switch (static_cast<FrameType>(frame.type)) {
    case FrameType::keep:
      return frame.length == 0 ? accept(frame) : refuse(frame, NackReason::bad_length);
    case FrameType::set:
      return on_set(frame);
    case FrameType::set_all:
      return on_set_all(frame);
    case FrameType::heat:
      return on_heat(frame);
    default:
      return refuse(frame, NackReason::unknown_type);
  }
}

// One that a newer frame has overtaken, or that came before: what it asks for is no longer wanted.
bool is_old(const Frame& frame) {
  return last_sequence >= 0 && static_cast<int8_t>(frame.sequence - static_cast<uint8_t>(last_sequence)) <= 0;
}

void handle(const Frame& frame) {
  const bool old = is_old(frame);
  const auto type = static_cast<FrameType>(frame.type);
  // A host that has started anew begins with these two, at any number.
  if (!old || type == FrameType::stop_all || type == FrameType::hello) last_sequence = frame.sequence;
  switch (type) {
    case FrameType::stop_all:
      motors::all_off();
      return accept(frame);
    case FrameType::hello:
      return on_hello(frame);
    case FrameType::status:
      return on_status(frame);
    default:
      break;
  }
  if (!motors::armed()) return refuse(frame, NackReason::unarmed);
  if (old) return accept(frame);
  motors::host_lives();
  act_on(frame);
}

void end_of_frame() {
  if (buffered == 0 && !oversize) return;  // a lone delimiter flushes the line; it is not a frame
  const uint8_t length = oversize ? 0 : cobs::decode(buffer, buffered);
  buffered = 0;
  oversize = false;
  constexpr uint8_t shortest = protocol::header_bytes + protocol::crc_bytes;
  if (length >= shortest) {
    const uint8_t covered = length - protocol::crc_bytes;
    if (u16_at(buffer + covered) == crc_of(buffer, covered)) {
      ++frames_ok;
      handle({buffer[0], buffer[1], buffer + protocol::header_bytes,
              static_cast<uint8_t>(covered - protocol::header_bytes)});
      return;
    }
  }
  ++frames_malformed;
}

}  // namespace

namespace session {

void receive(uint8_t byte) {
  if (byte == 0) {
    end_of_frame();
  } else if (buffered < protocol::encoded_max_bytes - 1) {
    buffer[buffered++] = byte;
  } else {
    oversize = true;
  }
}

}  // namespace session
