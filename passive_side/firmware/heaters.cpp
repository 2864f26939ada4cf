// SPDX-License-Identifier: Apache-2.0
#include "heaters.hpp"

#include <avr/io.h>
#include <util/atomic.h>

#include "analog.hpp"
#include "board.hpp"
#include "heater_times.hpp"
#include "heater_watch.hpp"
#include "motors.hpp"
#include "thermistor.hpp"

namespace protocol = telehug::protocol;
using protocol::HeaterFault;

namespace {

constexpr int16_t hysteresis = 2;  // 0.2 C
constexpr uint8_t remembered = 3;

struct Heater {
  uint16_t set_point;  // 0: off
  uint8_t periods_left;
  uint16_t readings[remembered];
  uint8_t read;  // of them, since the start
  uint8_t newest;
  int16_t temperature;
  bool wants_power;
  bool had_power;  // since the last reading
  HeaterFault fault;
  HeaterWatch watch;
};

Heater all[board::heater_count];
volatile uint8_t high_pins = 0;

static_assert(protocol::drive_max_ms <= 255, "periods_left is one byte");

// Of three readings the middle one: a single wrong one neither counts nor hides what the others say.
uint16_t middle(const uint16_t (&readings)[remembered]) {
  const uint16_t lesser = readings[0] < readings[1] ? readings[0] : readings[1];
  const uint16_t greater = readings[0] < readings[1] ? readings[1] : readings[0];
  if (readings[2] < lesser) return lesser;
  return readings[2] > greater ? greater : readings[2];
}

bool is_valid(uint16_t reading) {
  return !thermistor::is_open(reading) && !thermistor::is_short(reading);
}

HeaterFault fault_of(Heater& heater, uint16_t reading) {
  heater.temperature = protocol::no_temperature;
  if (thermistor::is_open(reading)) return HeaterFault::sensor_open;
  if (thermistor::is_short(reading)) return HeaterFault::sensor_short;
  heater.temperature = thermistor::temperature(reading);
  if (heater.temperature >= static_cast<int16_t>(protocol::heat_cutoff_decidegrees)) return HeaterFault::too_hot;
  return heater.watch.judge(heater.temperature, heater.set_point, heater.had_power);
}

void latch(Heater& heater, HeaterFault fault) {
  if (heater.fault == HeaterFault::none) heater.fault = fault;
}

// For power, the newest reading counts as well as the middle one: off at the first sign.
void regulate(Heater& heater, uint16_t newest) {
  if (!is_valid(newest) || heater.temperature == protocol::no_temperature) {
    heater.wants_power = false;
    return;
  }
  const int16_t temperature_now = thermistor::temperature(newest);
  const int16_t warmer = temperature_now > heater.temperature ? temperature_now : heater.temperature;
  const int16_t set_point = heater.set_point;
  if (warmer >= set_point) heater.wants_power = false;
  if (warmer <= set_point - hysteresis) heater.wants_power = true;
}

}  // namespace

namespace heaters {

void init() {
  heater_times::init();
}

uint8_t thermistor(uint8_t heater) {
  return board::thermistors[heater];
}

void set(uint8_t heater, uint16_t set_point, uint16_t duration_ms) {
  const uint16_t cut_ms = duration_ms < protocol::drive_max_ms ? duration_ms : protocol::drive_max_ms;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    if (motors::armed()) {
      all[heater].set_point = set_point;
      all[heater].periods_left = set_point == 0 ? 0 : static_cast<uint8_t>(cut_ms);
    }
  }
}

void all_off() {
  for (Heater& heater : all) {
    heater.periods_left = 0;
    heater.set_point = 0;
  }
  high_pins = 0;
}

void each_period(bool armed) {
  uint8_t high = 0;
  for (uint8_t i = 0; i < board::heater_count; ++i) {
    Heater& heater = all[i];
    if (heater.periods_left == 0) {
      heater.set_point = 0;
      continue;
    }
    --heater.periods_left;
    if (!armed || !heater.wants_power || fault(i) != HeaterFault::none) continue;
    heater.had_power = true;
    high |= board::heaters[i] | board::heater_supply;
  }
  high_pins = high;
}

void on_reading(uint8_t index, uint16_t reading) {
  Heater& heater = all[index];
  heater_times::pass(index, heater.set_point != 0);
  heater.readings[heater.newest] = reading;
  heater.newest = heater.newest + 1 == remembered ? 0 : heater.newest + 1;
  if (heater.read < remembered && ++heater.read < remembered) return;  // no temperature yet: no heat

  const HeaterFault found = fault_of(heater, middle(heater.readings));
  heater.had_power = false;
  if (found == HeaterFault::too_hot) {
    // Its own transistor may be what has failed: nothing may feed the heaters' common supply any more.
    for (Heater& each : all)
      latch(each, found);
  } else if (found != HeaterFault::none) {
    latch(heater, found);
  }
  regulate(heater, reading);
}

uint8_t pins() {
  return high_pins;
}

int16_t temperature(uint8_t heater) {
  int16_t value = protocol::no_temperature;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    if (all[heater].read == remembered) value = all[heater].temperature;
  }
  return value;
}

HeaterFault fault(uint8_t heater) {
  if (all[heater].fault != HeaterFault::none) return all[heater].fault;
  return heater_times::cooling_down(heater) ? HeaterFault::cooling_down : HeaterFault::none;
}

}  // namespace heaters
