// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "calibration/calibration.hpp"
#include "common/result.hpp"
#include "setup/dot_touches.hpp"
#include "setup/empty_screen.hpp"

namespace telehug {

// The calibration that follows from what was seen with nobody there and from the dots that were touched: the thesis'
// model of two, else the rig's camera. `camera` and `date` as in Calibration. The error says what to do again. Takes a
// second or two.
[[nodiscard]] Result<Calibration> solve_setup(const EmptyScreen& seen, const DotTouches& dots, bool thesis,
                                              const std::string& camera, const std::string& date);

}  // namespace telehug
