/* SPDX-License-Identifier: Apache-2.0 */
/* The one function that the firmware takes from avr-libc's header of this name: CRC-16, polynomial 0x1021. */
#pragma once

#include <stdint.h>

inline uint16_t _crc_xmodem_update(uint16_t crc, uint8_t byte) {
  uint32_t remainder = crc ^ static_cast<uint32_t>(byte) << 8;
  for (int bit = 0; bit < 8; ++bit)
    remainder = (remainder & 0x8000) != 0 ? (remainder << 1) ^ 0x1021 : remainder << 1;
  return static_cast<uint16_t>(remainder);
}
