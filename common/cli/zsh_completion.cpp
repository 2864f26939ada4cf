// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/completions.hpp"

namespace telehug {
namespace {

std::string function_name(const std::string& path) {
  std::string name = "_" + path;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '-' || c == ' '; }, '_');
  return name;
}

// In single quotes, within which _arguments gives brackets and colons a meaning.
std::string described(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
      continue;
    }
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string value_action(const OptionNode& option) {
  const std::string name = option.value.empty() ? "value" : option.value;
  if (!option.choices.empty()) return fmt::format(":{}:({})", described(name), fmt::join(option.choices, " "));
  return fmt::format(":{}:{}", described(name), option.takes_files() ? "_files" : " ");
}

std::string specifications(const OptionNode& option) {
  if (option.positional)
    return fmt::format(" \\\n    '{}{}'", option.several ? "*" : option.required ? "" : ":", value_action(option));
  std::string text;
  for (const std::string& name : option.names) {
    const std::string repeat = option.several && !option.value.empty() ? "*" : "";
    text += fmt::format(" \\\n    '{}{}[{}]{}'", repeat, name, described(option.help),
                        option.value.empty() ? "" : value_action(option));
  }
  return text;
}

std::string leaf(const CommandNode& command) {
  std::string text = fmt::format("{}() {{\n  _arguments", function_name(command.path));
  for (const OptionNode& option : command.options)
    text += specifications(option);
  return text + "\n}\n";
}

std::string branch(const CommandNode& command) {
  std::string text =
      fmt::format("{}() {{\n  local line state\n  local -a commands\n  commands=(\n", function_name(command.path));
  for (const CommandNode& below : command.commands)
    text += fmt::format("    '{}:{}'\n", below.name, described(below.help));
  text += "  )\n  _arguments -C";
  for (const OptionNode& option : command.options)
    text += specifications(option);
  text += " \\\n    '1:command:->command' '*::arguments:->arguments'\n  case $state in\n";
  text += fmt::format("    command) _describe -t commands '{} command' commands ;;\n", command.name);
  text += "    arguments) case $line[1] in\n";
  for (const CommandNode& below : command.commands)
    text += fmt::format("      {}) {} ;;\n", below.name, function_name(below.path));
  return text + "    esac ;;\n  esac\n}\n";
}

}  // namespace

std::string zsh_completion(const CommandNode& tree) {
  std::string text = fmt::format("#compdef {0}\n# {0}(1): completion for zsh\n", tree.name);
  for (const CommandNode* command : all_commands(tree))
    text += command->commands.empty() ? leaf(*command) : branch(*command);
  return text + fmt::format("{} \"$@\"\n", function_name(tree.path));
}

}  // namespace telehug
