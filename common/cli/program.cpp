// SPDX-License-Identifier: Apache-2.0
#include "cli/program.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "cli/command_tree.hpp"
#include "cli/completions.hpp"
#include "cli/help_text.hpp"
#include "cli/man_page.hpp"
#include "common/version.hpp"

namespace telehug {
namespace {

std::string with_paragraph(std::string text, const std::string& more) {
  if (!text.empty() && !text.ends_with('\n')) text += "\n\n";
  if (text.empty()) text = "\n";
  return text + more;
}

void set_footers(CLI::App& app, const CommandNode& node) {
  if (!node.examples.empty()) app.footer(with_paragraph(app.get_footer(), examples_text(node.examples)));
  for (const CommandNode& below : node.commands)
    set_footers(*app.get_subcommand(below.name), below);
}

ExitCode print_reference(const Program& program, const CommandNode& tree, std::string_view form,
                         std::string_view date) {
  if (form == "man") {
    fmt::print("{}", man_page(program, tree, date));
  } else if (form == "bash") {
    fmt::print("{}", bash_completion(tree));
  } else if (form == "zsh") {
    fmt::print("{}", zsh_completion(tree));
  } else if (form == "fish") {
    fmt::print("{}", fish_completion(tree));
  } else {
    fmt::print(stderr, "{}: --reference takes man, bash, zsh or fish\n", program.name);
    return ExitCode::usage;
  }
  return ExitCode::ok;
}

ExitCode parse_and_run(int argc, char** argv, const Program& program, const AddCommands& add_commands) {
  ExitCode result = ExitCode::ok;
  CLI::App app(std::string(program.purpose), std::string(program.name));
  app.set_version_flag("--version", version, "Print the version of this program");
  add_commands(app, result);
  const CommandNode tree = tree_of(app, program.examples);
  if (!tree.commands.empty()) app.require_subcommand(1);
  if ((argc == 3 || argc == 4) && std::string_view(argv[1]) == "--reference")
    return print_reference(program, tree, argv[2], argc == 4 ? argv[3] : "");
  set_footers(app, tree);
  app.footer("\n" + examples_text(headline_examples(tree, program.examples)) + "\n\n" + exit_codes_text(program.exits));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    // --help and --version come this way, too, with code 0.
    result = app.exit(problem) == 0 ? ExitCode::ok : ExitCode::usage;
  }
  return result;
}

}  // namespace

int run_program(int argc, char** argv, const Program& program, const AddCommands& add_commands) {
  try {
    const ExitCode result = parse_and_run(argc, argv, program, add_commands);
    // What was printed onto a full disk may be half of it: that is no success.
    if (std::fflush(stdout) != 0) throw std::runtime_error("the output can't be written: is the disk full?");
    return to_int(result);
  } catch (const std::exception& problem) {
    fmt::print(stderr, "{}: {}\n", program.name, problem.what());
    return to_int(ExitCode::internal);
  }
}

}  // namespace telehug
