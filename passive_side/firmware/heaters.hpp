// SPDX-License-Identifier: Apache-2.0
//
// Heaters that keep a temperature, each by a thermistor of its own. Everything that may turn one off (the end of its
// drive, the limit of 41 C, what a thermistor can't have read honestly, ten minutes on) is judged in the timer's
// interrupt, last before the pins: neither the host nor a main loop that hangs is between. A board without heaters has
// no_heaters.cpp in place of heaters.cpp.
#pragma once

#include <stdint.h>

#include "link/protocol.hpp"

namespace heaters {

void init();

// Input of the ADC at which the heater's thermistor is.
uint8_t thermistor(uint8_t heater);

// `set_point` in 0.1 C, at most heat_max_decidegrees; `duration_ms` is cut to drive_max_ms; 0 of either is off. Has no
// effect on a jacket that is not armed.
void set(uint8_t heater, uint16_t set_point, uint16_t duration_ms);

// With interrupts off. Ends all drives; faults and times stay.
void all_off();

// For the timer's interrupt: once a period, and for each reading of a thermistor (analog.hpp).
void each_period(bool armed);
void on_reading(uint8_t heater, uint16_t reading);

// Of port C, to be high now.
uint8_t pins();

// In 0.1 C, or no_temperature.
int16_t temperature(uint8_t heater);
telehug::protocol::HeaterFault fault(uint8_t heater);

}  // namespace heaters
