// SPDX-License-Identifier: Apache-2.0
//
// For how long a heater has been in use, kept through resets: a host that connects anew resets many boards, and would
// otherwise begin the ten minutes again.
#pragma once

#include <stdint.h>

namespace heater_times {

void init();

// Once for each reading of its thermistor. `in_use`: its drive runs, whether it needs power just now or not. Heating
// for heat_on_max_s makes it cool down for heat_cool_down_s; a shorter time off gives back twice of itself.
void pass(uint8_t heater, bool in_use);

bool cooling_down(uint8_t heater);

}  // namespace heater_times
