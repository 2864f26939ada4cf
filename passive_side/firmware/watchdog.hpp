// SPDX-License-Identifier: Apache-2.0
//
// Resets the microcontroller (all pins off) when the main loop or the timer interrupt hangs for 120 ms.
#pragma once

#include <stdint.h>

namespace watchdog {

void start();
void kick();  // only from the main loop: an interrupt may well run on while the loop hangs

// MCUSR as it was at the last reset; bit 3 (WDRF): the watchdog did it.
uint8_t reset_cause();

}  // namespace watchdog
