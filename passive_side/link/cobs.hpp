// SPDX-License-Identifier: Apache-2.0
//
// Consistent Overhead Byte Stuffing (Cheshire & Baker, IEEE/ACM Trans. Networking 7(2), 1999): removes every 0x00 from
// a packet, so that 0x00 can end it. For packets of up to 253 bytes, where it costs exactly one byte. Freestanding:
// shared by the microcontroller and the host.
#pragma once

#include <stdint.h>

namespace telehug {
namespace cobs {

// Writes length + 1 bytes to `out`, without the delimiter; returns that count. The buffers must not overlap.
inline uint8_t encode(const uint8_t* in, uint8_t length, uint8_t* out) {
  uint8_t code_at = 0;
  uint8_t written = 1;
  for (uint8_t i = 0; i < length; ++i) {
    if (in[i] == 0) {
      out[code_at] = static_cast<uint8_t>(written - code_at);
      code_at = written++;
    } else {
      out[written++] = in[i];
    }
  }
  out[code_at] = static_cast<uint8_t>(written - code_at);
  return written;
}

// Decodes `length` bytes (delimiter not included) in place; returns the length of the packet, 0 if it is not valid.
inline uint8_t decode(uint8_t* buffer, uint8_t length) {
  uint8_t read = 0;
  uint8_t written = 0;
  while (read < length) {
    const uint8_t code = buffer[read++];
    const uint8_t run = static_cast<uint8_t>(code - 1);
    if (code == 0 || run > length - read) return 0;
    for (uint8_t i = 0; i < run; ++i) {
      if (buffer[read] == 0) return 0;
      buffer[written++] = buffer[read++];
    }
    if (read < length) buffer[written++] = 0;
  }
  return written;
}

}  // namespace cobs
}  // namespace telehug
