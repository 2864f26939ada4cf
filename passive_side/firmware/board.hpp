// SPDX-License-Identifier: Apache-2.0
//
// Which pin of the ATmega328P is what. All boards have motors on D2..D12 and differ in port C (boards/, one file each;
// README.md shows the maps).
#pragma once

#include <avr/io.h>

#include "link/protocol.hpp"
#include TELEHUG_BOARD

namespace board {

// One value for each of the three ports.
struct PortImage {
  uint8_t b;
  uint8_t c;
  uint8_t d;
};

constexpr PortImage motor_pins = {0x1F, after_motors_of_c - first_motor_of_c, 0xFC};

constexpr uint8_t armed_led = 1 << PB5;
constexpr uint8_t rx_pull_up = 1 << PD0;  // an unplugged line reads as idle, not as a stream of zeros

static_assert((motor_pins.c & other_outputs_of_c) == 0, "a pin has one purpose");
static_assert(motor_count <= telehug::protocol::motor_count, "a SET names no more");
static_assert(heater_count <= telehug::protocol::heater_count, "a HEAT names no more");

// The pins of the channels for which `wanted(channel)` is true. Walks along the pins because the AVR shifts by a
// variable one bit at a time.
template <typename Wanted>
inline PortImage image_of(Wanted wanted) {
  PortImage image = {0, 0, 0};
  uint8_t channel = 0;
  for (uint8_t pin = 1 << PD2; pin != 0; pin <<= 1) {
    if (wanted(channel++)) image.d |= pin;
  }
  for (uint8_t pin = 1 << PB0; pin != 1 << PB5; pin <<= 1) {
    if (wanted(channel++)) image.b |= pin;
  }
  for (uint8_t pin = first_motor_of_c; pin != after_motors_of_c; pin <<= 1) {
    if (wanted(channel++)) image.c |= pin;
  }
  return image;
}

// `heaters`: pins of port C.
inline void write_ports(const PortImage& motors, uint8_t heaters, bool armed) {
  PORTD = motors.d | rx_pull_up;
  PORTB = armed ? motors.b | armed_led : motors.b;
  PORTC = motors.c | heaters;
}

inline void init() {
  // INT0 and INT1 stay disabled. Set to falling edge all the same, and before the pins go low: simavr polls
  // level-triggered ones in every cycle.
  EICRA = (1 << ISC11) | (1 << ISC01);
  write_ports({0, 0, 0}, 0, false);
  DDRB = motor_pins.b | armed_led;
  DDRC = motor_pins.c | other_outputs_of_c;
  DDRD = motor_pins.d;
}

}  // namespace board
