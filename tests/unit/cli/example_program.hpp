// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/command_tree.hpp"

namespace telehug {

// A command line with one of each kind: command below a command, choices, range, file, flag, positional.
struct ExampleProgram {
  Program program{.name = "tool",
                  .purpose = "Does it. All of it.",
                  .examples = {{"tool run --side left", "to the left"},
                               {"tool part list | head", "the parts"},
                               {"tool part list --json", "for programs"},
                               {"tool part add bolt.toml", "one more"}},
                  .exits = {ExitCode::ok, ExitCode::usage},
                  .see_also = {"telehug(7)"}};
  CLI::App app{"Does it. All of it.", "tool"};
  bool json = false;
  int speed = 1;
  std::string side;
  std::string file;

  ExampleProgram() {
    CLI::App* run = app.add_subcommand("run", "Run it - at once");
    run->add_option("--side", side, "Which way")->check(CLI::IsMember({"left", "right"}));
    run->add_option("--speed", speed, "How fast")->check(CLI::Range(1, 9));
    CLI::App* part = app.add_subcommand("part", "Its parts");
    part->require_subcommand(1);
    CLI::App* list = part->add_subcommand("list", "All of them, with their owner's name");
    list->add_flag("--json", json, "For programs [or you]");
    CLI::App* add = part->add_subcommand("add", "Another one");
    add->add_option("file", file, "Its description")->required()->type_name("FILE");
    add->footer("Parts are kept.");
  }

  [[nodiscard]] CommandNode tree() const { return tree_of(app, program.examples); }
};

}  // namespace telehug
