// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/command.hpp"
#include "eval/rig_evaluator.hpp"

namespace telehug {

// `telehug-active eval rigs`.
void add_eval_rigs(CLI::App& eval, ExitCode& result);

// Which algorithm, and whether the thesis' is to be seen beside it: the same for all that measure touches.
void add_algorithm_options(CLI::App& command, EvalAlgorithm& algorithm, bool& beside_thesis);

}  // namespace telehug
