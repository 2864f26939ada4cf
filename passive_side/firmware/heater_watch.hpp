// SPDX-License-Identifier: Apache-2.0
//
// Does the temperature do what heating makes it do? Tells a sensor that has come off its heater, and a heater that is
// far too strong.
#pragma once

#include <stdint.h>

#include "link/protocol.hpp"

class HeaterWatch {
 public:
  // Once for each reading. `heated`: it had power since the last one. Temperatures in 0.1 C; a set-point of 0 is none.
  telehug::protocol::HeaterFault judge(int16_t temperature, int16_t set_point, bool heated);

 private:
  bool rises_too_fast(int16_t temperature, bool heated);
  bool does_not_rise(int16_t temperature, int16_t set_point, bool heated);

  bool begun_ = false;
  // Time with power since the temperature was last seen to rise or to be high enough, less twice the time without.
  uint16_t readings_heated_ = 0;
  int16_t risen_to_ = 0;
  int16_t goal_ = 0;  // the highest set-point in that time: a lower one for a moment does not begin it anew

  uint8_t readings_in_window_ = 0;
  int16_t window_start_ = 0;
  bool heated_in_window_ = false;
};
