// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "cli/command_tree.hpp"

namespace telehug {

// Section 1 of the manual for a program. `date`: of the text, 2026-11-29.
[[nodiscard]] std::string man_page(const Program& program, const CommandNode& tree, std::string_view date);

}  // namespace telehug
