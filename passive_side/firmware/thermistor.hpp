// SPDX-License-Identifier: Apache-2.0
//
// From a reading to a temperature: NTC of 10 kOhm at 25 C, B 3950, to ground, with 10 kOhm to the supply against which
// the ADC measures, so that the supply does not matter.
#pragma once

#include <stdint.h>

namespace thermistor {

// Beyond these no wearer's jacket can be: the sensor, its cable or a contact is broken.
constexpr int16_t coldest_decidegrees = -200;
constexpr int16_t hottest_decidegrees = 800;

// Outside the two: the sensor is open (colder, or no reading) or shorted (hotter).
bool is_open(uint16_t reading);
bool is_short(uint16_t reading);

// In 0.1 C, within 0.1 C of the formula; `reading` is neither open nor short.
int16_t temperature(uint16_t reading);

}  // namespace thermistor
