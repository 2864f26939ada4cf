// SPDX-License-Identifier: Apache-2.0
//
// The board's motors, each with a strength (bit-angle modulation, 32 levels) and an end. The ends and the host's
// silence are counted in the timer interrupt: a motor goes off in time even while the main loop hangs.
#pragma once

#include <stdint.h>

namespace motors {

// Of the modulation. One stands for a millisecond in all times: they end 0.8 % early, never late.
constexpr uint16_t period_us = 992;

void init();

// True if the timer interrupt has run since the last call: without it nothing ends.
bool timer_lives();

// Off until armed, heaters as well; arming turns everything off. Anything but `host_lives` within keepalive_ms disarms.
void arm();
bool armed();
void host_lives();

// A change of several motors takes effect as a whole: begin_change(), set() for each, commit_change().
void begin_change();
// `duration_ms` is cut to drive_max_ms; an intensity or duration of 0 is off.
void set(uint8_t channel, uint8_t intensity, uint16_t duration_ms);
void commit_change();

void all_off();  // heaters, too

// Bit n: channel n is driven.
uint16_t running();

}  // namespace motors
