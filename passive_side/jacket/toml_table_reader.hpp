// SPDX-License-Identifier: Apache-2.0
//
// Reads TOML that people write, and tells them all that is wrong with it at once.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace telehug {

// Collects every fault of a file with its line.
class TomlFaults {
 public:
  explicit TomlFaults(std::string file) : file_(std::move(file)) {}

  void add(const toml::source_region& where, std::string_view sentence);
  [[nodiscard]] bool none() const { return lines_.empty(); }
  // In the order of lines; those of one line in the order in which they were found.
  [[nodiscard]] Error error() const;

 private:
  std::string file_;
  std::multimap<toml::source_index, std::string> lines_;
};

// Reads one table; says which of its keys are missing, wrong or unknown. `what`: how the table is called in a sentence.
class TomlTableReader {
 public:
  TomlTableReader(const toml::table& table, std::string what, TomlFaults& faults)
      : table_(table), what_(std::move(what)), faults_(faults) {}

  // T: std::int64_t, double, bool or std::string.
  template <typename T>
  std::optional<T> optional(std::string_view key);
  template <typename T>
  std::optional<T> required(std::string_view key);

  std::optional<std::int64_t> whole(std::string_view key, std::int64_t least, std::int64_t most);
  std::optional<std::int64_t> required_whole(std::string_view key, std::int64_t least, std::int64_t most);
  std::optional<double> number(std::string_view key, double least, double most);
  std::optional<double> required_number(std::string_view key, double least, double most);
  // One of `words`; its index.
  std::optional<std::size_t> word(std::string_view key, std::initializer_list<std::string_view> words);
  std::optional<std::size_t> required_word(std::string_view key, std::initializer_list<std::string_view> words);
  std::string required_name();

  void refuse_keys_other_than(std::initializer_list<std::string_view> known);
  void fault(std::string_view key, std::string_view sentence);
  [[nodiscard]] const toml::node* get(std::string_view key) const { return table_.get(key); }

  // The table under `key`; null if there is none, and if it is something else, which is a fault.
  [[nodiscard]] const toml::table* table(std::string_view key);

 private:
  bool has(std::string_view key);

  const toml::table& table_;
  std::string what_;
  TomlFaults& faults_;
};

// Reads `path` and calls `read` with its root. `if_missing`: the sentence if there is no such file. Errors: no such
// file, not readable, not valid TOML ("FILE:LINE: ...").
[[nodiscard]] std::optional<Error> read_toml(const std::filesystem::path& path, std::string_view if_missing,
                                             const std::function<void(const toml::table&)>& read);

}  // namespace telehug
