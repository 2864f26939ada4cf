// SPDX-License-Identifier: Apache-2.0
//
// What all programs of telehug have in common on the command line: examples and exit codes in --help, how they end, and
// what their manual and completions are made of.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "service/exit_code.hpp"

namespace CLI {
class App;
}

namespace telehug {

// An example belongs to the command that its words name, and stands in the --help and the manual of that.
struct Example {
  std::string_view line;
  std::string_view meaning;
};

struct Program {
  std::string_view name;
  std::string_view purpose;  // one sentence
  std::vector<Example> examples;
  std::vector<ExitCode> exits;             // that it can end with
  std::vector<std::string_view> see_also;  // "telehug(7)"
};

// Adds options and subcommands, whose callbacks leave how they ended.
using AddCommands = std::function<void(CLI::App&, ExitCode&)>;

// The whole of a main(). `NAME --reference man|bash|zsh|fish [DATE]` prints a reference instead of doing anything; the
// build calls it so.
[[nodiscard]] int run_program(int argc, char** argv, const Program& program, const AddCommands& add_commands);

}  // namespace telehug
