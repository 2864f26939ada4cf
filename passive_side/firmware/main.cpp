// SPDX-License-Identifier: Apache-2.0
//
// The jacket's microcontroller: turns what the passive side says on the serial line into motors that run and heaters
// that warm, and turns them off by itself when told nothing more.
#include <avr/interrupt.h>
#include <avr/sleep.h>

#include "analog.hpp"
#include "board.hpp"
#include "heaters.hpp"
#include "motors.hpp"
#include "session.hpp"
#include "uart.hpp"
#include "watchdog.hpp"

namespace {

// Both must live, this loop and the timer interrupt.
void kick_watchdog() {
  if (motors::timer_lives()) watchdog::kick();
}

}  // namespace

int main() {
  board::init();
  heaters::init();
  analog::init();
  motors::init();
  uart::init();
  watchdog::start();
  set_sleep_mode(SLEEP_MODE_IDLE);
  sei();
  for (;;) {
    uint8_t byte = 0;
    while (uart::read(byte)) {
      session::receive(byte);
      kick_watchdog();
    }
    kick_watchdog();
    sleep_mode();  // until the next interrupt: 0.5 ms at most, the timer of the motors
  }
}
