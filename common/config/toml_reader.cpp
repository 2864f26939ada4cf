// SPDX-License-Identifier: Apache-2.0
#include "config/toml_reader.hpp"

#include <fmt/core.h>

#include <toml++/toml.h>
#include <algorithm>
#include <optional>

#include "files/text_file.hpp"

namespace telehug {
namespace {

constexpr int most_syntax_faults = 20;

std::string place(const std::string& file, std::size_t line) {
  return fmt::format("{}:{}", file, line);
}

// Empties a line that can't be parsed, so that the rest of the file can be checked too. False if that would change
// what the rest means: a section's head, or a line that opens a text or list over several lines.
bool blank_line(std::string& text, toml::source_index number) {
  std::size_t begin = 0;
  for (toml::source_index line = 1; line < number; ++line) {
    begin = text.find('\n', begin);
    if (begin == std::string::npos) return false;
    ++begin;
  }
  const std::size_t end = std::min(text.find('\n', begin), text.size());
  const std::string_view content = std::string_view(text).substr(begin, end - begin);
  const std::size_t first = content.find_first_not_of(" \t");
  if (first == std::string_view::npos || content[first] == '[') return false;
  for (const std::string_view opens : {"\"\"\"", "'''", "[", "{"}) {
    if (content.find(opens) != std::string_view::npos) return false;
  }
  text.replace(begin, end - begin, end - begin, ' ');
  return true;
}

std::optional<toml::table> parse(std::string text, const std::string& name, std::vector<Fault>& faults) {
  for (int attempt = 0; attempt < most_syntax_faults; ++attempt) {
    try {
      return toml::parse(text, name);
    } catch (const toml::parse_error& problem) {
      const auto line = problem.source().begin.line;
      faults.push_back({place(name, line), fmt::format("not valid TOML: {}", problem.description())});
      if (!blank_line(text, line)) return std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<Value> value_of(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto whole = node.value_exact<std::int64_t>()) return static_cast<long long>(*whole);
  if (const auto real = node.value_exact<double>()) return *real;
  if (const auto flag = node.value_exact<bool>()) return *flag;
  return std::nullopt;
}

void read_section(const std::string& file, std::string_view section, const toml::table& content, std::vector<Key>& keys,
                  std::vector<Fault>& faults) {
  for (const auto& [name, node] : content) {
    const std::string where = place(file, node.source().begin.line);
    const auto key = std::find_if(keys.begin(), keys.end(),
                                  [&](const Key& k) { return k.section == section && k.name == name.str(); });
    if (key == keys.end()) {
      faults.push_back({where, fmt::format("there is no key {}.{}", section, name.str())});
      continue;
    }
    const auto value = value_of(node);
    const auto problem =
        value ? assign(*key, *value) : fmt::format("{} must be {}", key->path(), type_name(key->target));
    if (problem) {
      faults.push_back({where, *problem});
    } else {
      key->origin = where;
    }
  }
}

}  // namespace

void read_toml_text(std::string text, const std::string& name, std::vector<Key>& keys, std::vector<Fault>& faults) {
  if (const auto line = too_long_line(text); line != 0) {
    faults.push_back({place(name, line), fmt::format("the line is longer than {} bytes", longest_line_bytes)});
    return;
  }
  const auto document = parse(std::move(text), name, faults);
  if (!document) return;
  for (const auto& [section, node] : *document) {
    const bool known =
        std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return key.section == section.str(); });
    const std::string where = place(name, node.source().begin.line);
    if (!known) {
      faults.push_back({where, fmt::format("there is no section [{}]", section.str())});
    } else if (const toml::table* content = node.as_table()) {
      read_section(name, section.str(), *content, keys, faults);
    } else {
      faults.push_back(
          {where, fmt::format("{} is a section: write [{}] and its keys below", section.str(), section.str())});
    }
  }
}

void read_toml_file(const std::filesystem::path& file, std::vector<Key>& keys, std::vector<Fault>& faults) {
  auto text = read_text_file(file);
  if (!text) {
    faults.push_back({file.string(), text.error().message});
    return;
  }
  read_toml_text(*std::move(text), file.string(), keys, faults);
}

}  // namespace telehug
