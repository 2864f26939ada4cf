// SPDX-License-Identifier: Apache-2.0
//
// What the microcontroller measures: its thermistors and its own supply, one after the other, without waiting.
#pragma once

#include <stdint.h>

namespace analog {

// A reading is made of ten samples: the lowest and the highest do not count, so one that is wrong changes nothing. If
// the others differ by more than any temperature can, there is no reading.
constexpr uint8_t samples_counted = 8;
constexpr uint16_t reading_max = samples_counted * 1023;
constexpr uint16_t no_reading = 0xFFFF;

// Periods (of motors.cpp) that one input takes; the first samples after a change of input are not used.
constexpr uint8_t samples_skipped = 2;
constexpr uint8_t periods_per_reading = samples_skipped + samples_counted + 2;

void init();

// For the timer's interrupt. Ends in heaters::on_reading() when a thermistor has been read.
void each_period();

// Of the microcontroller, by its 1.1 V reference, which is good for 10 %; 0 before the first reading.
uint16_t supply_mv();

}  // namespace analog
