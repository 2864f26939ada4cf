// SPDX-License-Identifier: Apache-2.0
#include "cli/man_page.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/help_text.hpp"
#include "cli/roff.hpp"

namespace telehug {
namespace {

bool is_help(const OptionNode& option) {
  return std::find(option.names.begin(), option.names.end(), "--help") != option.names.end();
}

std::string in_synopsis(const OptionNode& option) {
  std::string text = option.positional ? option.names.front() : option.names.back();
  if (!option.positional && !option.value.empty()) text += " " + option.value;
  if (!option.required) text = "[" + text + "]";
  return option.several ? text + "..." : text;
}

std::string synopsis(const CommandNode& command) {
  std::string text = fmt::format(".B {}\n", roff(command.path));
  for (const OptionNode& option : command.options)
    if (!option.positional && !is_help(option)) text += roff(in_synopsis(option)) + '\n';
  if (!command.commands.empty()) text += ".I COMMAND\n";
  for (const OptionNode& option : command.options)
    if (option.positional) text += roff(in_synopsis(option)) + '\n';
  return text;
}

std::string option_text(const OptionNode& option) {
  std::string tag = fmt::format("{}", fmt::join(option.names, ", "));
  if (!option.positional && !option.value.empty()) tag += " " + option.value;
  std::string help = option.help;
  if (!option.choices.empty()) help += fmt::format(" ({})", fmt::join(option.choices, ", "));
  if (!option.limits.empty()) help += fmt::format(" ({})", option.limits);
  return roff_item(tag, help);
}

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of('\n');
  return first == std::string_view::npos ? "" : std::string(text.substr(first));
}

std::string command_text(const CommandNode& command) {
  std::string text = fmt::format(".SS {}\n{}", roff_argument(command.path), synopsis(command));
  text += fmt::format(".PP\n{}.\n", roff(command.help));
  for (const OptionNode& option : command.options)
    if (!is_help(option)) text += option_text(option);
  if (!command.notes.empty()) text += roff_example(trimmed(command.notes));
  if (!command.examples.empty()) text += roff_example(examples_text(command.examples));
  return text;
}

std::string name_line(const Program& program) {
  std::string purpose(program.purpose.substr(0, program.purpose.find('\n')));
  if (purpose.ends_with('.')) purpose.pop_back();
  if (!purpose.empty() && purpose[0] >= 'A' && purpose[0] <= 'Z') purpose[0] = static_cast<char>(purpose[0] + 32);
  return fmt::format("{} \\- {}\n", roff(program.name), roff(purpose));
}

}  // namespace

std::string man_page(const Program& program, const CommandNode& tree, std::string_view date) {
  std::string text = roff_title(program.name, 1, date);
  text += ".SH NAME\n" + name_line(program);
  text += ".SH SYNOPSIS\n" + synopsis(tree);
  text += ".SH DESCRIPTION\n" + roff(program.purpose) + '\n';
  if (!tree.commands.empty()) {
    text += ".SH COMMANDS\n";
    for (const CommandNode* command : all_commands(tree))
      if (command != &tree) text += command_text(*command);
  }
  text += ".SH OPTIONS\n";
  for (const OptionNode& option : tree.options)
    text += option_text(option);
  if (!tree.commands.empty()) text += ".PP\nEach command has\n.B \\-\\-help\nof its own.\n";
  text += ".SH EXIT STATUS\n" + roff_exit_status(program.exits);
  text += ".SH EXAMPLES\n";
  for (const Example& example : headline_examples(tree, program.examples))
    text += roff_item(example.line, example.meaning);
  text += ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < program.see_also.size(); ++i) {
    const std::string_view page = program.see_also[i];
    const std::size_t open = page.find('(');
    text += fmt::format(".BR {} {}{}\n", roff(page.substr(0, open)), page.substr(open),
                        i + 1 < program.see_also.size() ? "," : "");
  }
  return text;
}

}  // namespace telehug
