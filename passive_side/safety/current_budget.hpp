// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace telehug {

// What one motor is to draw.
struct Draw {
  double power = 0;        // 0..1 of full; 0: it is off
  double least_power = 0;  // less does not turn it
  double full_ma = 0;      // at full power, not below 0; 0: not known, not counted
};

// Makes them all together draw no more than `supply_ma` (0 or less: not limited). All that are counted are scaled
// alike. Of those that would no longer turn then the weakest (among equals the last) is left out, and it is tried
// again, so that of a touch at many places the strongest remain.
void fit_current(std::span<Draw> draws, double supply_ma) noexcept;

}  // namespace telehug
