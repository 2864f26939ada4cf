// SPDX-License-Identifier: Apache-2.0
#include "overlay/x11_key_grab.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace telehug {
namespace {

constexpr xcb_keysym_t num_lock_keysym = 0xFF7F;

using KeyCodes = XcbOwned<xcb_keycode_t>;  // ended by 0

}  // namespace

X11KeyGrab::X11KeyGrab(X11Connection connection, const KeyCombination& combination, std::string name)
    : connection_(std::move(connection)),
      combination_(combination),
      name_(std::move(name)),
      symbols_(xcb_key_symbols_alloc(connection_.get())) {}

// Which modifier NumLock is differs between keyboards. 0: none.
std::uint16_t X11KeyGrab::num_lock() const {
  const auto asked = xcb_get_modifier_mapping(connection_.get());
  const XcbOwned<xcb_get_modifier_mapping_reply_t> reply(
      xcb_get_modifier_mapping_reply(connection_.get(), asked, nullptr));
  const KeyCodes codes(xcb_key_symbols_get_keycode(symbols_.get(), num_lock_keysym));
  if (!reply || !codes || reply->keycodes_per_modifier == 0) {
    return 0;
  }
  const std::span<const xcb_keycode_t> modifiers(
      xcb_get_modifier_mapping_keycodes(reply.get()),
      static_cast<std::size_t>(xcb_get_modifier_mapping_keycodes_length(reply.get())));
  for (const xcb_keycode_t* code = codes.get(); *code != XCB_NO_SYMBOL; ++code) {
    const auto place = std::find(modifiers.begin(), modifiers.end(), *code);
    if (place != modifiers.end()) {
      return static_cast<std::uint16_t>(1U << ((place - modifiers.begin()) / reply->keycodes_per_modifier));
    }
  }
  return 0;
}

X11KeyGrab::Keys X11KeyGrab::find_keys() const {
  Keys keys;
  if (const KeyCodes codes(xcb_key_symbols_get_keycode(symbols_.get(), combination_.keysym)); codes) {
    for (const xcb_keycode_t* code = codes.get(); *code != XCB_NO_SYMBOL; ++code) {
      keys.codes.push_back(*code);
    }
  }
  keys.modifiers = static_cast<std::uint16_t>(
      (combination_.ctrl ? XCB_MOD_MASK_CONTROL : 0) | (combination_.alt ? XCB_MOD_MASK_1 : 0) |
      (combination_.shift ? XCB_MOD_MASK_SHIFT : 0) | (combination_.super ? XCB_MOD_MASK_4 : 0));
  const std::uint16_t caps = XCB_MOD_MASK_LOCK;
  keys.locks = {0, caps};
  if (const std::uint16_t num = num_lock(); num != 0) {
    keys.locks.push_back(num);
    keys.locks.push_back(static_cast<std::uint16_t>(num | caps));
  }
  return keys;
}

Status X11KeyGrab::bind() {
  xcb_connection_t* const server = connection_.get();
  xcb_ungrab_key(server, XCB_GRAB_ANY, connection_.root(), XCB_MOD_MASK_ANY);
  keys_ = find_keys();
  if (keys_.codes.empty()) {
    return Error{fmt::format("The keyboard has no key for {}; choose another combination.", name_)};
  }
  std::vector<xcb_void_cookie_t> asked;
  for (const xcb_keycode_t code : keys_.codes) {
    for (const std::uint16_t lock : keys_.locks) {
      asked.push_back(xcb_grab_key_checked(server, 0, connection_.root(),
                                           static_cast<std::uint16_t>(keys_.modifiers | lock), code,
                                           XCB_GRAB_MODE_ASYNC, XCB_GRAB_MODE_ASYNC));
    }
  }
  bool taken = false;
  for (const xcb_void_cookie_t& cookie : asked) {
    const XcbOwned<xcb_generic_error_t> error(xcb_request_check(server, cookie));
    taken = taken || error;
  }
  if (taken) {
    return Error{fmt::format("Another program has taken {} already; choose another combination.", name_)};
  }
  return Done{};
}

int X11KeyGrab::take_presses() {
  int presses = 0;
  bool layout_changed = false;
  while (const auto event = connection_.next_event()) {
    // Not is_x11_event(): keys that another program made up don't count.
    if (event->response_type == XCB_KEY_RELEASE || event->response_type == XCB_KEY_PRESS) {
      const auto& key = reinterpret_cast<const xcb_key_press_event_t&>(*event);  // releases have the same form
      if (std::find(keys_.codes.begin(), keys_.codes.end(), key.detail) == keys_.codes.end()) {
        continue;  // while the combination is held all keys come here
      }
      if (event->response_type == XCB_KEY_RELEASE) {
        released_ = key.time;
      } else if (released_ != key.time) {  // a key that is held repeats: released and pressed at the same time
        ++presses;
      }
    } else if (event->response_type == XCB_MAPPING_NOTIFY) {
      xcb_refresh_keyboard_mapping(symbols_.get(), reinterpret_cast<xcb_mapping_notify_event_t*>(event.get()));
      layout_changed = true;
    }
  }
  if (layout_changed && find_keys() != keys_) {
    bound_ = bind();
  }
  return presses;
}

Status X11KeyGrab::state() const {
  if (connection_.broken()) {
    return Error{fmt::format("The X11 display {} is gone; start its session again.", connection_.display())};
  }
  return bound_;
}

}  // namespace telehug
