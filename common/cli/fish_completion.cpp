// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/completions.hpp"

namespace telehug {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

std::string function_name(const std::string& program) {
  std::string name = "__" + program + "_path";
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string option_line(const std::string& start, const OptionNode& option) {
  std::string text = start;
  if (!option.positional) {
    for (const std::string& name : option.names)
      text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    text += " -d " + quoted(option.help);
    if (!option.value.empty()) text += option.takes_files() ? " -r -F" : " -x";
  } else if (option.takes_files()) {
    text += " -F";
  }
  if (!option.choices.empty()) text += " -a " + quoted(fmt::format("{}", fmt::join(option.choices, " ")));
  return text + '\n';
}

}  // namespace

std::string fish_completion(const CommandNode& tree) {
  const std::string function = function_name(tree.name);
  std::string paths;
  std::string lines;
  for (const CommandNode* command : all_commands(tree)) {
    if (command != &tree) paths += ' ' + quoted(command->path);
    const std::string start =
        fmt::format("complete -c {} -n \"test ({}) = {}\"", tree.name, function, quoted(command->path));
    for (const CommandNode& below : command->commands)
      lines += fmt::format("{} -a {} -d {}\n", start, below.name, quoted(below.help));
    for (const OptionNode& option : command->options) {
      // A positional that takes anything has nothing to offer.
      if (!option.positional || option.takes_files() || !option.choices.empty()) lines += option_line(start, option);
    }
  }
  return fmt::format(
      "# {0}(1): completion for fish\n"
      "function {1} --description 'The command that the line names so far'\n"
      "  set -l path {0}\n"
      "  for word in (commandline -opc)[2..]\n"
      "    if contains -- \"$path $word\"{2}\n"
      "      set path \"$path $word\"\n"
      "    end\n"
      "  end\n"
      "  echo $path\n"
      "end\n"
      "complete -c {0} -f\n"
      "{3}",
      tree.name, function, paths, lines);
}

}  // namespace telehug
