// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xcb/xcb_keysyms.h>
#include <xcb/xtest.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "doubles/x11_client.hpp"

namespace telehug {

inline constexpr xcb_keysym_t ctrl = 0xFFE3;
inline constexpr xcb_keysym_t alt = 0xFFE9;
inline constexpr xcb_keysym_t caps_lock = 0xFFE5;
inline constexpr xcb_keysym_t num_lock = 0xFF7F;

// Somebody at the keyboard.
class X11Typist {
 public:
  explicit X11Typist(const std::string& display) : client_(display) {}

  [[nodiscard]] xcb_keycode_t code(xcb_keysym_t sign) {
    xcb_key_symbols_t* symbols = xcb_key_symbols_alloc(client_.get());
    const std::unique_ptr<xcb_keycode_t, decltype(&std::free)> codes(xcb_key_symbols_get_keycode(symbols, sign),
                                                                     &std::free);
    const xcb_keycode_t first = codes ? *codes : 0;
    xcb_key_symbols_free(symbols);
    if (first == 0) throw std::runtime_error("no key for " + std::to_string(sign));
    return first;
  }
  void press(xcb_keycode_t code) { fake(XCB_KEY_PRESS, code); }
  void release(xcb_keycode_t code) { fake(XCB_KEY_RELEASE, code); }

  // Presses keys one after the other and releases them in the opposite order.
  void type(const std::vector<xcb_keysym_t>& signs) {
    for (const xcb_keysym_t sign : signs)
      press(code(sign));
    for (auto sign = signs.rbegin(); sign != signs.rend(); ++sign)
      release(code(*sign));
  }

  void put(xcb_keysym_t sign, xcb_keycode_t code) {
    const std::vector<xcb_keysym_t> signs{sign, sign};
    xcb_change_keyboard_mapping(client_.get(), 1, code, 2, signs.data());
    client_.sync();
  }
  void sync() { client_.sync(); }

 private:
  void fake(std::uint8_t what, xcb_keycode_t code) {
    // After 2 ms: nobody releases a key and presses it again within the same one, only repeating keys do that.
    xcb_test_fake_input(client_.get(), what, code, 2, XCB_NONE, 0, 0, 0);
    client_.sync();
  }

  X11Client client_;
};

}  // namespace telehug
