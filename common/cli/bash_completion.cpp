// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/completions.hpp"

namespace telehug {
namespace {

std::string function_name(const std::string& program) {
  std::string name = "_" + program;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// What comes behind an option that takes a value.
std::string value_case(const CommandNode& command, const OptionNode& option) {
  std::vector<std::string> patterns;
  patterns.reserve(option.names.size());
  for (const std::string& name : option.names)
    patterns.push_back(fmt::format("'{} {}'", command.path, name));
  std::string action = "return";
  if (!option.choices.empty()) {
    action = fmt::format("words='{}'", fmt::join(option.choices, " "));
  } else if (option.takes_files()) {
    action = "files=yes";
  }
  return fmt::format("    {}) {} ;;\n", fmt::join(patterns, "|"), action);
}

std::string words_case(const CommandNode& command) {
  std::vector<std::string> words;
  bool files = false;
  for (const CommandNode& below : command.commands)
    words.push_back(below.name);
  for (const OptionNode& option : command.options) {
    if (option.positional) {
      words.insert(words.end(), option.choices.begin(), option.choices.end());
      files = files || option.takes_files();
    } else {
      words.insert(words.end(), option.names.begin(), option.names.end());
    }
  }
  return fmt::format("      '{}') words='{}'{} ;;\n", command.path, fmt::join(words, " "), files ? " files=yes" : "");
}

}  // namespace

std::string bash_completion(const CommandNode& tree) {
  std::string paths;
  std::string values;
  std::string words;
  for (const CommandNode* command : all_commands(tree)) {
    if (command != &tree) paths += fmt::format("{}'{}'", paths.empty() ? "" : "|", command->path);
    for (const OptionNode& option : command->options)
      if (!option.positional && !option.value.empty()) values += value_case(*command, option);
    words += words_case(*command);
  }
  const std::string function = function_name(tree.name);
  return fmt::format(
      "# {0}(1): completion for bash\n"
      "{1}() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} path={0} words= files= i\n"
      "  COMPREPLY=()\n"
      "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
      "    case \"$path ${{COMP_WORDS[i]}}\" in\n"
      "      {2}) path+=\" ${{COMP_WORDS[i]}}\" ;;\n"
      "    esac\n"
      "  done\n"
      "  case \"$path ${{COMP_WORDS[COMP_CWORD - 1]}}\" in\n"
      "{3}"
      "    *) case $path in\n"
      "{4}"
      "    esac ;;\n"
      "  esac\n"
      "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
      "  if [[ $files && $word != -* ]]; then\n"
      "    compopt -o filenames 2>/dev/null\n"
      "    mapfile -t -O \"${{#COMPREPLY[@]}}\" COMPREPLY < <(compgen -f -- \"$word\")\n"
      "  fi\n"
      "}}\n"
      "complete -F {1} {0}\n",
      tree.name, function, paths.empty() ? "''" : paths, values, words);
}

}  // namespace telehug
