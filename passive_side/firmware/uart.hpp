// SPDX-License-Identifier: Apache-2.0
//
// The serial line, 8N1, interrupt driven with a ring for each direction. Nothing here waits.
#pragma once

#include <stdint.h>

namespace uart {

void init();

// False if no byte has come.
bool read(uint8_t& byte);

// True if that many bytes can be written now.
bool has_room(uint8_t length);
void write(uint8_t byte);

// Bytes that were lost because nobody read them in time.
uint16_t overruns();

}  // namespace uart
