// SPDX-License-Identifier: Apache-2.0
//
// Times, counted in readings of one thermistor.
#pragma once

#include "analog.hpp"
#include "board.hpp"
#include "motors.hpp"

// All thermistors and the reference take turns: every 36 ms with two heaters.
constexpr uint32_t reading_us = motors::period_us * analog::periods_per_reading * (board::heater_count + 1);

constexpr uint16_t readings_in_ms(uint32_t ms) {
  return static_cast<uint16_t>(1000 * ms / reading_us);
}
