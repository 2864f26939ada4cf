// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xcb/xcb_keysyms.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "overlay/key_combination.hpp"
#include "screen_x11/x11_connection.hpp"

namespace telehug {

// A key combination grabbed from a server, as long as one connection to it lasts.
class X11KeyGrab {
 public:
  X11KeyGrab(X11Connection connection, const KeyCombination& combination, std::string name);

  // Grabs the combination, on whichever keys the keyboard has it now and whether CapsLock and NumLock are on or not.
  Status bind();

  // How often the combination was pressed since the last call. Follows the keyboard to another layout.
  int take_presses();

  // Fails if no press can come any more.
  [[nodiscard]] Status state() const;

 private:
  struct Keys {
    std::vector<xcb_keycode_t> codes;
    std::uint16_t modifiers = 0;
    std::vector<std::uint16_t> locks;  // to be ignored, in all their combinations

    friend bool operator==(const Keys&, const Keys&) = default;
  };
  struct FreeSymbols {
    void operator()(xcb_key_symbols_t* symbols) const noexcept { xcb_key_symbols_free(symbols); }
  };

  [[nodiscard]] Keys find_keys() const;
  [[nodiscard]] std::uint16_t num_lock() const;

  X11Connection connection_;
  KeyCombination combination_;
  std::string name_;
  std::unique_ptr<xcb_key_symbols_t, FreeSymbols> symbols_;
  Keys keys_;
  Status bound_ = Done{};
  std::optional<xcb_timestamp_t> released_;  // when the key was released last
};

}  // namespace telehug
