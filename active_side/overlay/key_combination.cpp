// SPDX-License-Identifier: Apache-2.0
#include "overlay/key_combination.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>

namespace telehug {
namespace {

constexpr std::uint32_t first_function_keysym = 0xFFBE;
constexpr int most_function_keys = 24;

struct NamedKey {
  std::string_view name;
  std::uint32_t keysym;
  bool types;  // needed for writing text
};
constexpr std::array named_keys{
    NamedKey{"space", 0x20, true},    NamedKey{"pause", 0xFF13, false}, NamedKey{"scrolllock", 0xFF14, false},
    NamedKey{"print", 0xFF61, false}, NamedKey{"insert", 0xFF63, true}, NamedKey{"home", 0xFF50, true},
    NamedKey{"end", 0xFF57, true},    NamedKey{"pageup", 0xFF55, true}, NamedKey{"pagedown", 0xFF56, true},
    NamedKey{"delete", 0xFFFF, true},
};

// Without the spaces around it, in lower case.
std::string plain(std::string_view part) {
  const auto first = part.find_first_not_of(" \t");
  if (first == std::string_view::npos) {
    return {};
  }
  std::string word(part.substr(first, part.find_last_not_of(" \t") - first + 1));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return word;
}

bool* modifier(KeyCombination& combination, std::string_view word) {
  if (word == "ctrl") return &combination.ctrl;
  if (word == "alt") return &combination.alt;
  if (word == "shift") return &combination.shift;
  if (word == "super") return &combination.super;
  return nullptr;
}

struct Key {
  std::uint32_t keysym;
  bool types;
};

std::optional<Key> find_key(std::string_view word) {
  if (word.size() == 1 && std::isalnum(static_cast<unsigned char>(word.front())) != 0) {
    return Key{static_cast<std::uint32_t>(word.front()), true};  // letters and digits are numbered as in ASCII
  }
  const auto named =
      std::find_if(named_keys.begin(), named_keys.end(), [word](const NamedKey& key) { return key.name == word; });
  if (named != named_keys.end()) {
    return Key{named->keysym, named->types};
  }
  int number = 0;
  if (word.starts_with('f')) {
    const char* const after = word.data() + word.size();
    const auto [end, error] = std::from_chars(word.data() + 1, after, number);
    if (error == std::errc() && end == after && number >= 1 && number <= most_function_keys) {
      return Key{first_function_keysym + static_cast<std::uint32_t>(number) - 1, false};
    }
  }
  return std::nullopt;
}

}  // namespace

Result<KeyCombination> parse_key_combination(std::string_view text) {
  const auto wrong = [text](std::string_view why) {
    return Error{fmt::format("The key combination \"{}\" {}; write one like Ctrl+Alt+H.", text, why)};
  };
  KeyCombination combination;
  std::string_view rest = text;
  for (auto plus = rest.find('+'); plus != std::string_view::npos; plus = rest.find('+')) {
    const std::string word = plain(rest.substr(0, plus));
    rest.remove_prefix(plus + 1);
    bool* const held = modifier(combination, word);
    if (held == nullptr) {
      return wrong(fmt::format("has \"{}\" where Ctrl, Alt, Shift or Super is expected", word));
    }
    if (*held) {
      return wrong(fmt::format("has {} twice", word));
    }
    *held = true;
  }
  const std::string word = plain(rest);
  if (word.empty() || modifier(combination, word) != nullptr) {
    return wrong("has no key at its end");
  }
  const auto key = find_key(word);
  if (!key) {
    return wrong(
        fmt::format("has the unknown key \"{}\" (there are letters, digits, F1 to F24, Space, Pause, "
                    "ScrollLock, Print, Insert, Delete, Home, End, PageUp and PageDown)",
                    word));
  }
  if (key->types && !combination.ctrl && !combination.alt && !combination.super) {
    return wrong("would take a key away that is needed for typing, so it needs Ctrl, Alt or Super");
  }
  combination.keysym = key->keysym;
  return combination;
}

}  // namespace telehug
