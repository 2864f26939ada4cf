// SPDX-License-Identifier: Apache-2.0
//
// What a shell offers while a command line is typed: commands, options, the words that an option may be, or files.
#pragma once

#include <string>

#include "cli/command_tree.hpp"

namespace telehug {

[[nodiscard]] std::string bash_completion(const CommandNode& tree);
[[nodiscard]] std::string zsh_completion(const CommandNode& tree);
[[nodiscard]] std::string fish_completion(const CommandNode& tree);

}  // namespace telehug
