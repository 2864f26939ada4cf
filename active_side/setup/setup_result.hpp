// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "calibration/calibration.hpp"
#include "setup/setup_state.hpp"

namespace telehug {

// What a person should know of a solved calibration. `dots`: all that were to be touched; `taken`: those that were, in
// the order in which they were given to the solver.
[[nodiscard]] SetupResult judge_setup(const Calibration& calibration, const std::vector<ScreenPoint>& dots,
                                      const std::vector<bool>& taken);

// The same if nothing could be solved.
[[nodiscard]] SetupResult failed_setup(const std::string& why, const std::vector<ScreenPoint>& dots,
                                       const std::vector<bool>& taken);

}  // namespace telehug
