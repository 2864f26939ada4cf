// SPDX-License-Identifier: Apache-2.0
//
// The jacket's microcontroller: turns what the passive side says on the serial line into motors that run, and turns
// them off by itself when told nothing more.
#include <avr/interrupt.h>
#include <avr/sleep.h>

#include "board.hpp"
#include "motors.hpp"
#include "session.hpp"
#include "uart.hpp"
#include "watchdog.hpp"

int main() {
  board::init();
  motors::init();
  uart::init();
  watchdog::start();
  set_sleep_mode(SLEEP_MODE_IDLE);
  sei();
  for (;;) {
    uint8_t byte = 0;
    while (uart::read(byte)) {
      session::receive(byte);
      watchdog::kick();
    }
    watchdog::kick();
    sleep_mode();  // until the next interrupt: 0.5 ms at most, the timer of the motors
  }
}
