// SPDX-License-Identifier: Apache-2.0
//
// For boards that have none.
#include "heaters.hpp"

namespace heaters {

void init() {}
uint8_t thermistor(uint8_t) {
  return 0;
}
void set(uint8_t, uint16_t, uint16_t) {}
void all_off() {}
void each_period(bool) {}
void on_reading(uint8_t, uint16_t) {}
uint8_t pins() {
  return 0;
}
int16_t temperature(uint8_t) {
  return telehug::protocol::no_temperature;
}
telehug::protocol::HeaterFault fault(uint8_t) {
  return telehug::protocol::HeaterFault::none;
}

}  // namespace heaters
