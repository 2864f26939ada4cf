// SPDX-License-Identifier: Apache-2.0
#include "analog.hpp"

#include <avr/io.h>
#include <util/atomic.h>

#include "board.hpp"
#include "heaters.hpp"

namespace {

constexpr uint8_t against_avcc = 1 << REFS0;
constexpr uint8_t bandgap_input = 0x0E;
constexpr uint16_t bandgap_mv = 1100;
constexpr uint8_t steady_counts = 32;               // 3 C, in 10 ms
constexpr uint8_t reference = board::heater_count;  // the input after the thermistors

uint8_t input = 0;
uint8_t sample = 0;
uint16_t sum = 0;
uint16_t lowest = 0;
uint16_t second_lowest = 0;
uint16_t highest = 0;
uint16_t second_highest = 0;
bool missed = false;  // the converter did not answer in time
volatile uint16_t bandgap_reading = 0;

void start_reading() {
  sample = 0;
  sum = 0;
  lowest = second_lowest = 1023;
  highest = second_highest = 0;
  missed = false;
  ADMUX = against_avcc | (input == reference ? bandgap_input : heaters::thermistor(input));
}

void take_sample(uint16_t value) {
  sum += value;
  if (value < lowest) {
    second_lowest = lowest;
    lowest = value;
  } else if (value < second_lowest) {
    second_lowest = value;
  }
  if (value > highest) {
    second_highest = highest;
    highest = value;
  } else if (value > second_highest) {
    second_highest = value;
  }
}

void end_reading() {
  const bool valid = !missed && second_highest - second_lowest <= steady_counts;
  const uint16_t reading = valid ? sum - lowest - highest : analog::no_reading;
  if (input != reference) {
    heaters::on_reading(input, reading);
  } else if (valid) {
    bandgap_reading = reading;
  }
  input = input == reference ? 0 : input + 1;
}

}  // namespace

namespace analog {

void init() {
  ADCSRA = (1 << ADEN) | (1 << ADPS2) | (1 << ADPS1) | (1 << ADPS0);  // 16 MHz / 128: a conversion takes 104 us
  start_reading();
  ADCSRA |= 1 << ADSC;
}

// Takes the conversion that was started in the period before, and starts the next.
void each_period() {
  if ((ADCSRA & (1 << ADSC)) != 0) {
    missed = true;
  } else if (sample >= samples_skipped) {
    take_sample(ADC);
  }
  if (++sample == periods_per_reading) {
    end_reading();
    start_reading();
  }
  ADCSRA |= 1 << ADSC;
}

uint16_t supply_mv() {
  uint16_t reading = 0;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    reading = bandgap_reading;
  }
  return reading == 0 ? 0 : static_cast<uint16_t>(uint32_t{bandgap_mv} * reading_max / reading);
}

}  // namespace analog
