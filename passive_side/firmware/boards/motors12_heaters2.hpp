// SPDX-License-Identifier: Apache-2.0
//
// Twelve motors: channels 0..5 are D2..D7, 6..10 are D8..D12, 11 is A4. Thermistors: A0, A1. Heaters: A2, A3, both fed
// through one more transistor on A5: a transistor that has failed can be cut off by the other, and the program of a
// board with other wiring heats nothing, since none of them drives A5. D13 is the LED.
//
// Of port C, only A4 and A5 may switch while a thermistor is read (datasheet, "ADC noise canceling techniques"); the
// heaters' pins don't (heaters.cpp).
#pragma once

namespace board {

constexpr uint8_t motor_count = 12;
constexpr uint8_t heater_count = 2;

constexpr uint8_t first_motor_of_c = 1 << PC4;
constexpr uint8_t after_motors_of_c = 1 << PC5;

constexpr uint8_t heater_supply = 1 << PC5;  // of port C, as the heaters
constexpr uint8_t heaters[heater_count] = {1 << PC2, 1 << PC3};
constexpr uint8_t thermistors[heater_count] = {0, 1};  // inputs of the ADC
constexpr uint8_t thermistor_pins = 1 << PC0 | 1 << PC1;

constexpr uint8_t other_outputs_of_c = heater_supply | heaters[0] | heaters[1];

}  // namespace board
