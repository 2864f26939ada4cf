// SPDX-License-Identifier: Apache-2.0
//
// Bit-angle modulation: a period is cut into five slices of 16, 8, 4, 2 and 1 units; a motor is high in the slices
// whose bits are set in its level. That takes five interrupts a period where counting up to 32 levels takes 31.
//
// Timer 2 counts in 4 us steps; a unit is 8 of them, a period of 31 units 992 us.
#include "motors.hpp"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#include "analog.hpp"
#include "board.hpp"
#include "heaters.hpp"

namespace protocol = telehug::protocol;
using board::PortImage;

namespace {

constexpr uint8_t slices = 5;
constexpr uint8_t unit_counts = 8;
constexpr uint8_t full_level = 31;
constexpr uint8_t preparing_slice = 2;  // the last one that is long enough (128 us) for the work
constexpr uint8_t measuring_slice = 0;  // the longest (512 us): when the thermistors are read, no pin of port C changes

// One buffer is shown, one may wait for the next period, the main loop draws into the third.
constexpr uint8_t buffer_count = 3;
PortImage buffers[buffer_count][slices];
volatile uint8_t shown = 0;
volatile uint8_t next = 0;
volatile uint8_t committed = 0;
volatile bool change_committed = false;

uint8_t level[board::motor_count];
volatile uint8_t periods_left[board::motor_count];  // as shown
uint8_t new_periods_left[board::motor_count];       // taken over with the buffer
volatile bool changed[board::motor_count];

// Pins whose drive has not ended, in this period and in the next.
PortImage live = {0, 0, 0};
PortImage next_live = {0, 0, 0};
volatile bool is_armed = false;
volatile uint16_t silent_periods = 0;
uint8_t slice = 0;

volatile bool timer_has_run = false;

static_assert(protocol::drive_max_ms <= 255, "periods_left is one byte");
static_assert(motors::period_us == ((1 << slices) - 1) * unit_counts * 4, "what the timer counts");

uint8_t level_of(uint8_t intensity) {
  if (intensity == 0) return 0;
  const uint8_t rounded = static_cast<uint8_t>((uint16_t{intensity} * full_level + 127) / 255);
  return rounded == 0 ? 1 : rounded;
}

void clear_all() {
  for (uint8_t channel = 0; channel < board::motor_count; ++channel) {
    periods_left[channel] = 0;
    changed[channel] = false;
  }
  change_committed = false;
  live = {0, 0, 0};
  next_live = live;
  heaters::all_off();
  board::write_ports(live, heaters::pins(), is_armed);
}

inline void take_over_change() {
  next = committed;
  for (uint8_t channel = 0; channel < board::motor_count; ++channel) {
    if (!changed[channel]) continue;
    changed[channel] = false;
    periods_left[channel] = new_periods_left[channel];
  }
  change_committed = false;
}

inline void prepare_next_period() {
  if (is_armed) {
    silent_periods = silent_periods + 1;
    if (silent_periods >= protocol::keepalive_ms) {
      is_armed = false;
      clear_all();
    }
  }
  if (change_committed) take_over_change();
  next_live = board::image_of([](uint8_t channel) {
    const uint8_t left = periods_left[channel];
    if (left == 0) return false;
    periods_left[channel] = left - 1;
    return true;
  });
}

}  // namespace

ISR(TIMER2_COMPA_vect) {
  const uint8_t now = slice;
  slice = now == slices - 1 ? 0 : now + 1;
  // The timer restarts from 0 by itself (CTC); this is the length of the slice that has just begun.
  OCR2A = (unit_counts << (slices - 1 - now)) - 1;
  if (now == 0) {
    shown = next;
    live = next_live;
  }
  // The same short way to the pins in every slice: a longer one in some would shift strength between slices.
  const PortImage& image = buffers[shown][now];
  board::write_ports({static_cast<uint8_t>(image.b & live.b), static_cast<uint8_t>(image.c & live.c),
                      static_cast<uint8_t>(image.d & live.d)},
                     heaters::pins(), is_armed);
  if (now == preparing_slice) prepare_next_period();
  if (now == measuring_slice) {
    timer_has_run = true;
    analog::each_period();
    heaters::each_period(is_armed);
  }
}

namespace motors {

void init() {
  TCCR2A = 1 << WGM21;  // CTC
  OCR2A = unit_counts - 1;
  TIMSK2 = 1 << OCIE2A;
  TCCR2B = 1 << CS22;  // 16 MHz / 64
}

bool timer_lives() {
  const bool lives = timer_has_run;
  timer_has_run = false;
  return lives;
}

void arm() {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    is_armed = true;
    silent_periods = 0;
    clear_all();
  }
}

bool armed() {
  return is_armed;
}

void host_lives() {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    silent_periods = 0;
  }
}

void begin_change() {
  // A change that was committed less than a period ago and not yet shown is carried on, not lost: its motors stay in
  // `changed`.
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    change_committed = false;
  }
}

void set(uint8_t channel, uint8_t intensity, uint16_t duration_ms) {
  const uint16_t cut_ms = duration_ms < protocol::drive_max_ms ? duration_ms : protocol::drive_max_ms;
  level[channel] = level_of(intensity);
  new_periods_left[channel] = intensity == 0 ? 0 : static_cast<uint8_t>(cut_ms);
  changed[channel] = true;
}

void commit_change() {
  uint8_t drawn = 0;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    while (drawn == shown || drawn == next)
      ++drawn;
  }
  for (uint8_t i = 0; i < slices; ++i) {
    const uint8_t bit = 1 << (slices - 1 - i);
    buffers[drawn][i] = board::image_of([bit](uint8_t channel) { return (level[channel] & bit) != 0; });
  }
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    committed = drawn;
    change_committed = is_armed;
  }
}

void all_off() {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    clear_all();
  }
}

uint16_t running() {
  uint16_t channels = 0;
  for (uint8_t channel = 0; channel < board::motor_count; ++channel) {
    if (periods_left[channel] != 0) channels |= uint16_t{1} << channel;
  }
  return channels;
}

}  // namespace motors
