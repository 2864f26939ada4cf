// SPDX-License-Identifier: Apache-2.0
//
// Sixteen motors: channels 0..5 are D2..D7, 6..10 are D8..D12, 11..15 are A0..A4. D13 is the LED, A5 is free.
#pragma once

namespace board {

constexpr uint8_t motor_count = 16;
constexpr uint8_t heater_count = 0;

constexpr uint8_t first_motor_of_c = 1 << PC0;
constexpr uint8_t after_motors_of_c = 1 << PC5;

constexpr uint8_t other_outputs_of_c = 0;

}  // namespace board
