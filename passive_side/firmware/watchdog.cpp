// SPDX-License-Identifier: Apache-2.0
#include "watchdog.hpp"

#include <avr/io.h>
#include <avr/wdt.h>

namespace {

// Not cleared at start-up: written before .bss is.
uint8_t saved_reset_cause __attribute__((section(".noinit")));

}  // namespace

// After a watchdog reset the dog keeps running at 15 ms: it must be stopped before anything that takes time
// (avr-libc manual, <avr/wdt.h>).
extern "C" void stop_watchdog_early() __attribute__((naked, used, section(".init3")));
void stop_watchdog_early() {
  saved_reset_cause = MCUSR;
  MCUSR = 0;
  wdt_disable();
}

namespace watchdog {

void start() {
  wdt_enable(WDTO_120MS);
}
void kick() {
  wdt_reset();
}
uint8_t reset_cause() {
  return saved_reset_cause;
}

}  // namespace watchdog
