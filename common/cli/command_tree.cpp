// SPDX-License-Identifier: Apache-2.0
#include "cli/command_tree.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>
#include <sstream>

namespace telehug {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);)
    parts.push_back(part);
  return parts;
}

// CLI11 tells what an option may be as text alone: "MINUTES:INT in [1 - 1440]", "TEXT:{active,passive}".
void add_type(OptionNode& node, const std::string& type) {
  const std::size_t colon = type.find(':');
  node.value = type.substr(0, colon);
  if (colon == std::string::npos) return;
  const std::string check = type.substr(colon + 1);
  const std::size_t first = check.find_first_of("{[");
  const std::size_t last = check.find_last_of("}]");
  if (first == std::string::npos || last == std::string::npos || last < first) return;
  const std::string inner = check.substr(first + 1, last - first - 1);
  if (check[first] == '{') {
    node.choices = split(inner, ',');
  } else if (const std::size_t dash = inner.find(" - "); dash != std::string::npos) {
    node.limits = inner.substr(0, dash) + " to " + inner.substr(dash + 3);
  }
}

OptionNode node_of(const CLI::Option& option) {
  OptionNode node;
  node.positional = option.get_positional() && option.get_lnames().empty() && option.get_snames().empty();
  if (node.positional) {
    node.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames())
      node.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
      node.names.push_back("--" + name);
  }
  node.required = option.get_required();
  node.several = option.get_expected_max() > 1 || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  node.help = option.get_description();
  if (option.get_items_expected_max() > 0) add_type(node, option.get_type_name());
  return node;
}

CommandNode node_of(const CLI::App& app, const std::string& above) {
  CommandNode node;
  node.name = app.get_name();
  node.path = above.empty() ? node.name : above + " " + node.name;
  node.help = app.get_description();
  node.notes = app.get_footer();
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) node.options.push_back(node_of(*option));
  for (const CLI::App* command : app.get_subcommands({}))
    if (!command->get_group().empty()) node.commands.push_back(node_of(*command, node.path));
  return node;
}

CommandNode* find_command(CommandNode& root, std::string_view line) {
  std::istringstream words{std::string(line)};
  std::string word;
  if (!(words >> word) || word != root.name) return nullptr;
  CommandNode* found = &root;
  while (words >> word) {
    const auto below =
        std::find_if(found->commands.begin(), found->commands.end(), [&](const auto& c) { return c.name == word; });
    if (below == found->commands.end()) break;
    found = &*below;
  }
  return found;
}

void collect(const CommandNode& node, std::vector<const CommandNode*>& all) {
  all.push_back(&node);
  for (const CommandNode& below : node.commands)
    collect(below, all);
}

}  // namespace

bool OptionNode::takes_files() const {
  return value.starts_with("FILE") || value.starts_with("DIR") || value.ends_with("_DIR") || value == "PICTURE" ||
         value == "SOCKET" || value == "PATH";
}

CommandNode tree_of(const CLI::App& app, const std::vector<Example>& examples) {
  CommandNode root = node_of(app, "");
  for (const Example& example : examples)
    if (CommandNode* command = find_command(root, example.line)) command->examples.push_back(example);
  return root;
}

const CommandNode* command_named(const CommandNode& root, std::string_view line) {
  return find_command(const_cast<CommandNode&>(root), line);  // NOLINT(*-const-cast): nothing is changed
}

std::vector<const CommandNode*> all_commands(const CommandNode& root) {
  std::vector<const CommandNode*> all;
  collect(root, all);
  return all;
}

std::vector<Example> headline_examples(const CommandNode& root, const std::vector<Example>& examples) {
  std::set<std::string> seen;
  std::vector<Example> first;
  for (const Example& example : examples) {
    std::istringstream words{std::string(example.line)};
    std::string program;
    std::string command;
    words >> program >> command;
    // A program without commands shows all that it has.
    if (root.commands.empty() || seen.insert(command).second) first.push_back(example);
  }
  return first;
}

}  // namespace telehug
