// SPDX-License-Identifier: Apache-2.0
//
// What stands at the end of --help.
#pragma once

#include <string>
#include <vector>

#include "cli/program.hpp"

namespace telehug {

// "Examples:" and a line for each.
[[nodiscard]] std::string examples_text(const std::vector<Example>& examples);
// "Exit codes:" and what each means.
[[nodiscard]] std::string exit_codes_text(const std::vector<ExitCode>& codes);

}  // namespace telehug
