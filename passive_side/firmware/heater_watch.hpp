// SPDX-License-Identifier: Apache-2.0
//
// Does the temperature do what heating makes it do? Tells a sensor that has come off its heater, and a heater that is
// far too strong.
#pragma once

#include <stdint.h>

#include "link/protocol.hpp"

class HeaterWatch {
 public:
  // Once for each reading. `heated`: it had power since the last one. `satisfied`: the set-point is reached.
  // Temperatures in 0.1 C.
  telehug::protocol::HeaterFault judge(int16_t temperature, int16_t set_point, bool heated, bool satisfied);

 private:
  bool rises_too_fast(int16_t temperature, bool heated);
  bool does_not_rise(int16_t temperature, int16_t set_point, bool heated, bool satisfied);

  bool begun_ = false;
  // Time with power since the temperature was last seen to rise, less twice the time without.
  uint16_t readings_heated_ = 0;
  int16_t risen_to_ = 0;

  uint8_t readings_in_window_ = 0;
  int16_t window_start_ = 0;
  bool heated_in_window_ = false;
};
