// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "eval/error_group.hpp"
#include "eval/touch_eval.hpp"

namespace telehug {

// The table that `eval touch` prints: what was missed, wrong and falsely found, mean and 95th percentile of the
// vertical and horizontal error; altogether and by what the touches have in common. Says so if there is no truth.
std::string format_error_table(const EvalTouchReport& report);

// Columns of such a table: what they are, their heads, and the row of a group.
std::string error_legend();
std::string error_heads();
std::string error_row(const std::string& name, const ErrorGroup& group);

}  // namespace telehug
