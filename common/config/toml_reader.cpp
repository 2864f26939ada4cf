// SPDX-License-Identifier: Apache-2.0
#include "config/toml_reader.hpp"

#include <fmt/core.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

namespace telehug {
namespace {

// A configuration is a few kB; this keeps a wrong path (a disk, a recording) from filling the memory.
constexpr std::size_t most_bytes = 1 << 20;
constexpr int most_syntax_faults = 20;
// toml++ makes a table of every dot in a key and takes them apart recursively: a line of 100 kB overflows the stack.
constexpr std::size_t longest_line = 4096;

std::string place(const std::string& file, toml::source_index line) {
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

// The number of the first line that is too long; 0 if none is.
toml::source_index too_long_line(std::string_view text) {
  toml::source_index number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > longest_line) return number;
    begin = end + 1;
  }
  return 0;
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
    faults.push_back({place(name, line), fmt::format("the line is longer than {} bytes", longest_line)});
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
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  if (stream) {
    text.resize(most_bytes + 1);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
  }
  // Reaching the end sets failbit and eofbit; anything else is a failure to open or to read.
  if (!stream.is_open() || stream.bad() || (stream.fail() && !stream.eof())) {
    faults.push_back({file.string(), fmt::format("can't be read: {}", std::strerror(errno))});
    return;
  }
  if (text.size() > most_bytes) {
    faults.push_back({file.string(), "is larger than 1 MiB, so it is no configuration file"});
    return;
  }
  read_toml_text(std::move(text), file.string(), keys, faults);
}

}  // namespace telehug
