// SPDX-License-Identifier: Apache-2.0
//
// Jacket protocol, version 1: what the passive side and the microcontroller say to each other. Both ends include this
// header, so it is freestanding (avr-g++ 5.4 has no C++ library) and plain C++14.
//
// A frame on the wire: COBS( type u8 | sequence u8 | payload | CRC-16 little-endian ) 0x00.
// The CRC covers type to payload; polynomial 0x1021, initial value 0xFFFF, no reflection (CRC-16/CCITT-FALSE).
// Multi-byte numbers are little-endian. The sequence number grows by one a frame from the host; the answer repeats it.
// The sequence number tells frames that come twice or late: one that is up to 128 below the newest (modulo 256) is
// acknowledged and has no effect. stop_all and hello count whatever their number is, and begin a new count.
#pragma once

#include <stdint.h>

namespace telehug {
namespace protocol {

constexpr uint8_t version = 1;

enum class FrameType : uint8_t {
  // Host to microcontroller
  hello = 0x01,     // lowest version u8, highest version u8, nonce u16: arms the jacket, all motors off
  keep = 0x02,      // nothing: the host lives
  stop_all = 0x03,  // nothing: everything off at once; accepted always, armed or not
  set = 0x10,       // 1..16 times (channel u8, intensity u8, duration u8 in 10 ms); other motors are left as they are
  set_all = 0x11,   // 16 intensities u8, duration u16 in ms
  status = 0x12,    // nothing: asks for telemetry
  heat = 0x13,      // 1..2 times (heater u8, set-point u16 in 0.1 C, duration u8 in 10 ms); other heaters as they are
  // Microcontroller to host
  caps = 0x81,       // Caps: the answer to hello
  ack = 0x82,        // type u8 of the accepted frame
  nack = 0x83,       // type u8 of the refused frame, NackReason u8
  telemetry = 0x92,  // Telemetry: the answer to status
};

enum class NackReason : uint8_t {
  unknown_type = 1,
  bad_length = 2,
  unarmed = 3,      // no hello yet, or the keepalive was lost: say hello again
  bad_channel = 4,  // nothing of the frame was applied
  bad_version = 5,  // the versions of host and firmware do not overlap
  bad_value = 6,    // a set-point above heat_max_decidegrees; nothing of the frame was applied
};

// Why the microcontroller keeps a heater off. All but cooling_down last until its next reset.
enum class HeaterFault : uint8_t {
  none = 0,
  sensor_open = 1,  // or no sensor at all: no sensor, no heater
  sensor_short = 2,
  too_hot = 3,  // heat_cutoff_decidegrees was reached
  no_rise = 4,  // heated, but the sensor does not get warmer: it has come off
  rises_too_fast = 5,
  cooling_down = 6,  // on for heat_on_max_s: off for heat_cool_down_s
};

// Payload of caps, in this order on the wire.
struct Caps {
  uint8_t protocol;
  uint8_t firmware;
  uint8_t motors;
  uint8_t heaters;
  uint8_t temperatures;
  uint8_t levels;             // intensities that can be told apart, off included
  uint8_t encoded_max_bytes;  // longest frame it takes, with COBS overhead and delimiter
  uint8_t keepalive_10ms;     // silence after which all goes off
  uint8_t drive_max_10ms;     // longer durations are cut to this
  uint8_t reset_cause;        // MCUSR at the last reset
  uint16_t nonce;             // of the hello it answers
};
constexpr uint8_t caps_bytes = 12;

// Payload of telemetry, in this order on the wire: this, then for each temperature of the caps (value i16 in 0.1 C or
// no_temperature, HeaterFault u8 of the heater of that number). Counters wrap.
struct Telemetry {
  uint16_t frames_ok;
  uint16_t frames_malformed;  // bad COBS, CRC or size
  uint16_t bytes_overrun;     // bytes that the UART or its ring lost
  uint8_t reset_cause;
  uint8_t armed;       // 0 or 1
  uint16_t running;    // bit n: channel n is driven now
  uint16_t supply_mv;  // of the microcontroller
};
constexpr uint8_t telemetry_bytes = 12;
constexpr uint8_t temperature_bytes = 3;  // each
constexpr int16_t no_temperature = -32768;

constexpr uint8_t motor_count = 16;  // at most
constexpr uint8_t heater_count = 2;  // at most; each with a temperature of its own
constexpr uint8_t intensity_levels = 32;
constexpr uint8_t hello_bytes = 4;
constexpr uint8_t set_entry_bytes = 3;
constexpr uint8_t set_all_bytes = motor_count + 2;
constexpr uint8_t heat_entry_bytes = 4;

constexpr uint8_t header_bytes = 2;
constexpr uint8_t crc_bytes = 2;
constexpr uint16_t crc_initial = 0xFFFF;
constexpr uint8_t encoded_max_bytes = 64;                     // delimiter included
constexpr uint8_t decoded_max_bytes = encoded_max_bytes - 2;  // one COBS byte, delimiter
constexpr uint8_t payload_max_bytes = decoded_max_bytes - header_bytes - crc_bytes;

constexpr uint16_t keepalive_ms = 500;
constexpr uint16_t drive_max_ms = 250;  // of heaters, too

// Worn parts stay below 41 C in normal use and after any single fault (IEC 60601-1, 2nd edition).
constexpr uint16_t heat_max_decidegrees = 400;
constexpr uint16_t heat_cutoff_decidegrees = 410;
constexpr uint16_t heat_on_max_s = 600;
constexpr uint16_t heat_cool_down_s = 300;

static_assert(motor_count * set_entry_bytes <= payload_max_bytes, "a SET of all motors fits into one frame");

}  // namespace protocol
}  // namespace telehug
