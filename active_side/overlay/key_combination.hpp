// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace telehug {

struct KeyCombination {
  bool ctrl = false;
  bool alt = false;
  bool shift = false;
  bool super = false;
  std::uint32_t keysym = 0;  // X11's number of the key's unshifted sign

  friend bool operator==(const KeyCombination&, const KeyCombination&) = default;
};

// "Ctrl+Alt+H": modifiers (Ctrl, Alt, Shift, Super) and a key (a letter, a digit, F1 to F24, Space, Pause, ScrollLock,
// Print, Insert, Delete, Home, End, PageUp, PageDown), in upper or lower case. Fails if it isn't, or if the key is
// needed for typing and no Ctrl, Alt or Super goes with it.
Result<KeyCombination> parse_key_combination(std::string_view text);

}  // namespace telehug
