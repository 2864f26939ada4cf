// SPDX-License-Identifier: Apache-2.0
//
// A program's command line as values: what the manual and the completions are made of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/program.hpp"

namespace telehug {

struct OptionNode {
  std::vector<std::string> names;  // "-h", "--help"; of a positional its name alone
  bool positional = false;
  bool required = false;
  bool several = false;
  std::string value;  // what it takes: "FILE"; empty: nothing
  std::vector<std::string> choices;
  std::string limits;  // "1 to 1440"; empty: none
  std::string help;

  [[nodiscard]] bool takes_files() const;
};

struct CommandNode {
  std::string path;  // "telehug pair invite"
  std::string name;  // "invite"
  std::string help;
  std::string notes;  // what --help says at its end, but for the examples
  std::vector<OptionNode> options;
  std::vector<CommandNode> commands;
  std::vector<Example> examples;  // of this very command
};

[[nodiscard]] CommandNode tree_of(const CLI::App& app, const std::vector<Example>& examples);

// The command that a line names: its words as far as they are names of commands. Nothing if the program is another.
[[nodiscard]] const CommandNode* command_named(const CommandNode& root, std::string_view line);

// This and all below it, each before those below it.
[[nodiscard]] std::vector<const CommandNode*> all_commands(const CommandNode& root);

// The first example of each of the program's commands, in their given order.
[[nodiscard]] std::vector<Example> headline_examples(const CommandNode& root, const std::vector<Example>& examples);

}  // namespace telehug
