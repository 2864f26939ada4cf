// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "common/result.hpp"
#include "eval/rigs_eval.hpp"
#include "eval/touch_eval.hpp"
#include "eval_report/report.hpp"

namespace telehug {

// Of one recording. `thesis`: what the thesis' algorithm made of the same pictures, or why it could not.
Report report_of(const EvalTouchReport& evaluated, const std::optional<Result<EvalTouchReport>>& thesis,
                 const std::string& date);

// Of many virtual rigs.
Report report_of(const EvalRigsOptions& options, const RigsResult& result, const std::string& date);

}  // namespace telehug
