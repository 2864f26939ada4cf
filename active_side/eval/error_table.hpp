// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "eval/touch_eval.hpp"

namespace telehug {

// A found touch farther than this from the truth is counted as wrong.
inline constexpr double near_enough_mm = 10;

// The table that `eval touch` prints: what was missed, wrong and falsely found, mean and 95th percentile of the
// vertical and horizontal error; altogether, by skin tone and by what the screen showed. Says so if there is no truth.
std::string format_error_table(const EvalTouchReport& report);

}  // namespace telehug
