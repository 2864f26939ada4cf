// SPDX-License-Identifier: Apache-2.0
//
// One key of a configuration: where its value lives, what it may be, and what it is for. Everything that telehug knows
// of a key follows from its row in active_keys.cpp, passive_keys.cpp or (of both sides) key_rows.cpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/config.hpp"

namespace telehug {

// Both ends belong to it.
struct Range {
  double least = 0;
  double most = 0;
};
struct OneOf {
  std::vector<std::string_view> choices;
};
// Returns what is wrong with a text; nothing if it is fine.
using TextCheck = std::function<std::optional<std::string>(std::string_view)>;

using Limits = std::variant<std::monostate, Range, OneOf, TextCheck>;

// The member of a configuration that a key sets; its present content is the default.
using Target = std::variant<std::string*, int*, double*, bool*>;

using Value = std::variant<std::string, long long, double, bool>;

struct Key {
  std::string_view section;
  std::string_view name;
  Target target;
  std::string_view unit;  // empty: none
  Limits limits;
  std::string_view help;
  // "file:line" or the flag that set it last; empty: still the default. The rows leave it out, which g++ wants said.
  std::string origin = {};  // NOLINT(readability-redundant-member-init)

  [[nodiscard]] std::string path() const;
};

// The tables: one row a key, bound to the members of `config`, which must outlive it.
[[nodiscard]] std::vector<Key> keys_of(ActiveConfig& config);
[[nodiscard]] std::vector<Key> keys_of(PassiveConfig& config);

struct Fault {
  std::string where;  // "file:line", or the flag
  std::string what;   // one sentence without the place
};

// Faults that no key has alone. The places come from the keys' origins.
[[nodiscard]] std::vector<Fault> impossible_combinations(const ActiveConfig& config, const std::vector<Key>& keys);
[[nodiscard]] std::vector<Fault> impossible_combinations(const PassiveConfig& config, const std::vector<Key>& keys);

// Stores a value if the key may have it; returns what is wrong otherwise (then the key is as it was).
[[nodiscard]] std::optional<std::string> assign(Key& key, const Value& value);

// The value that a text on the command line means for this key: nothing if it can't be read as the key's type.
[[nodiscard]] std::optional<Value> value_from_text(const Key& key, std::string_view text);

[[nodiscard]] std::string_view type_name(const Target& target);
// "1 .. 240", "default | thesis", or empty.
[[nodiscard]] std::string limits_text(const Limits& limits);
// As it is written in a file.
[[nodiscard]] std::string toml_text(const Target& target);

}  // namespace telehug
