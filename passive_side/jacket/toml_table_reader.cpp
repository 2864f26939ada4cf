// SPDX-License-Identifier: Apache-2.0
#include "jacket/toml_table_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "files/text_file.hpp"

namespace telehug {
namespace {

template <typename T>
constexpr std::string_view type_name() {
  if (std::is_same_v<T, std::int64_t>) return "a whole number";
  if (std::is_same_v<T, bool>) return "true or false";
  return std::is_same_v<T, double> ? "a number" : "a text in quotes";
}

}  // namespace

void TomlFaults::add(const toml::source_region& where, std::string_view sentence) {
  lines_.emplace(where.begin.line, fmt::format("{}:{}: {}", file_, where.begin.line, sentence));
}

Error TomlFaults::error() const {
  std::string text;
  for (const auto& [line, sentence] : lines_)
    text += (text.empty() ? "" : "\n") + sentence;
  return {text};
}

template <typename T>
std::optional<T> TomlTableReader::optional(std::string_view key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return std::nullopt;
  if constexpr (std::is_same_v<T, double>) {
    if (node->is_number()) return node->value<double>();
  } else {
    if (const auto value = node->value_exact<T>()) return value;
  }
  fault(key, fmt::format("must be {}", type_name<T>()));
  return std::nullopt;
}
template std::optional<std::int64_t> TomlTableReader::optional(std::string_view);
template std::optional<double> TomlTableReader::optional(std::string_view);
template std::optional<bool> TomlTableReader::optional(std::string_view);
template std::optional<std::string> TomlTableReader::optional(std::string_view);

bool TomlTableReader::has(std::string_view key) {
  if (table_.contains(key)) return true;
  faults_.add(table_.source(), fmt::format("{} has no {}; add it", what_, key));
  return false;
}

std::optional<std::int64_t> TomlTableReader::whole(std::string_view key, std::int64_t least, std::int64_t most) {
  const auto value = optional<std::int64_t>(key);
  if (!value || (*value >= least && *value <= most)) return value;
  fault(key, fmt::format("is {} but must be {}..{}", *value, least, most));
  return std::nullopt;
}

std::optional<std::int64_t> TomlTableReader::required_whole(std::string_view key, std::int64_t least,
                                                            std::int64_t most) {
  return has(key) ? whole(key, least, most) : std::nullopt;
}

std::optional<double> TomlTableReader::number(std::string_view key, double least, double most) {
  const auto value = optional<double>(key);
  if (!value || (std::isfinite(*value) && *value >= least && *value <= most)) return value;
  fault(key, fmt::format("is {} but must be {}..{}", *value, least, most));
  return std::nullopt;
}

std::optional<double> TomlTableReader::required_number(std::string_view key, double least, double most) {
  return has(key) ? number(key, least, most) : std::nullopt;
}

std::optional<std::size_t> TomlTableReader::word(std::string_view key, std::initializer_list<std::string_view> words) {
  const auto value = optional<std::string>(key);
  if (!value) return std::nullopt;
  const auto* found = std::ranges::find(words, *value);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  fault(key, fmt::format("is \"{}\" but must be \"{}\"", *value, fmt::join(words, "\" or \"")));
  return std::nullopt;
}

std::optional<std::size_t> TomlTableReader::required_word(std::string_view key,
                                                          std::initializer_list<std::string_view> words) {
  return has(key) ? word(key, words) : std::nullopt;
}

std::string TomlTableReader::required_name() {
  if (!has("name")) return "";
  const auto name = optional<std::string>("name");
  if (name && name->empty()) fault("name", "is empty; a person reads it");
  return name.value_or("");
}

void TomlTableReader::refuse_keys_other_than(std::initializer_list<std::string_view> known) {
  for (const auto& [key, node] : table_) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    faults_.add(key.source(),
                fmt::format("{}: unknown key {}; known are {}", what_, key.str(), fmt::join(known, ", ")));
  }
}

void TomlTableReader::fault(std::string_view key, std::string_view sentence) {
  const toml::node* node = table_.get(key);
  faults_.add(node != nullptr ? node->source() : table_.source(), fmt::format("{}: {} {}", what_, key, sentence));
}

const toml::table* TomlTableReader::table(std::string_view key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) faults_.add(node->source(), fmt::format("{0} must be a table: [{0}]", key));
  return node->as_table();
}

std::optional<Error> read_toml(const std::filesystem::path& path, std::string_view if_missing,
                               const std::function<void(const toml::table&)>& read) {
  const std::string file = path.string();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    return Error{fmt::format("{}: {}", file, if_missing)};
  }
  try {
    const auto text = read_text_file(path);
    if (!text) return Error{fmt::format("{}: {}", file, text.error().message)};
    read(toml::parse(*text, file));
    return std::nullopt;
  } catch (const toml::parse_error& error) {
    return Error{fmt::format("{}:{}: not valid TOML: {}", file, error.source().begin.line, error.description())};
  }
}

}  // namespace telehug
