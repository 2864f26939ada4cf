// SPDX-License-Identifier: Apache-2.0
#include "thermistor.hpp"

#include <avr/pgmspace.h>

#include "analog.hpp"

namespace {

constexpr uint8_t step_decidegrees = 50;
constexpr uint8_t point_count =
    (thermistor::hottest_decidegrees - thermistor::coldest_decidegrees) / step_decidegrees + 1;

// R = R25 exp(B (1/T - 1/T25)); folded by the compiler, nothing of this floating point reaches the controller.
constexpr uint16_t reading_at(int16_t decidegrees) {
  const double ratio = __builtin_exp(3950.0 * (1 / (decidegrees / 10.0 + 273.15) - 1 / 298.15));
  return static_cast<uint16_t>(analog::reading_max * ratio / (ratio + 1));
}

struct Table {
  uint16_t reading[point_count];
};

constexpr Table make_table() {
  Table table = {};
  for (uint8_t i = 0; i < point_count; ++i) {
    table.reading[i] = reading_at(thermistor::coldest_decidegrees + i * step_decidegrees);
  }
  return table;
}

constexpr Table table PROGMEM = make_table();  // falls: the warmer, the less

constexpr uint16_t coldest_reading = reading_at(thermistor::coldest_decidegrees);
constexpr uint16_t hottest_reading = reading_at(thermistor::hottest_decidegrees);

}  // namespace

namespace thermistor {

bool is_open(uint16_t reading) {
  return reading > coldest_reading;
}
bool is_short(uint16_t reading) {
  return reading < hottest_reading;
}

int16_t temperature(uint16_t reading) {
  int16_t decidegrees = coldest_decidegrees;
  const uint16_t* point = table.reading;
  uint16_t colder = pgm_read_word(point);
  for (;; decidegrees += step_decidegrees) {
    const uint16_t warmer = pgm_read_word(++point);
    if (reading >= warmer) return decidegrees + step_decidegrees * (colder - reading) / (colder - warmer);
    colder = warmer;
  }
}

}  // namespace thermistor
