// SPDX-License-Identifier: Apache-2.0
//
// Which pin of the ATmega328P is what. The only file to change for another wiring (README.md shows the map).
#pragma once

#include <avr/io.h>

#include "link/protocol.hpp"

namespace board {

// One value for each of the three ports.
struct PortImage {
  uint8_t b;
  uint8_t c;
  uint8_t d;
};

constexpr PortImage motor_pins = {0x1F, 0x1F, 0xFC};

constexpr uint8_t armed_led = 1 << PB5;
constexpr uint8_t rx_pull_up = 1 << PD0;  // an unplugged line reads as idle, not as a stream of zeros

// The pins of the channels for which `wanted(channel)` is true. Channels 0..5 are PD2..PD7, 6..10 are PB0..PB4, 11..15
// are PC0..PC4. Walks along the pins because the AVR shifts by a variable one bit at a time.
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
  for (uint8_t pin = 1 << PC0; pin != 1 << PC5; pin <<= 1) {
    if (wanted(channel++)) image.c |= pin;
  }
  return image;
}

inline void write_ports(const PortImage& motors, bool armed) {
  PORTD = motors.d | rx_pull_up;
  PORTB = armed ? motors.b | armed_led : motors.b;
  PORTC = motors.c;
}

inline void init() {
  // INT0 and INT1 stay disabled. Set to falling edge all the same, and before the pins go low: simavr polls
  // level-triggered ones in every cycle.
  EICRA = (1 << ISC11) | (1 << ISC01);
  write_ports({0, 0, 0}, false);
  DDRB = motor_pins.b | armed_led;
  DDRC = motor_pins.c;
  DDRD = motor_pins.d;
}

}  // namespace board
