// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "screen_x11/x11_connection.hpp"
#include "screen_x11/x11_damage.hpp"

namespace telehug {

// A window of another program whose pixels the server keeps even where other windows cover it. Its events (of
// structure and properties) come through the connection. Needs the extension Composite, its version agreed upon.
class X11PinnedWindow {
 public:
  X11PinnedWindow(const X11Connection& connection, xcb_window_t window);  // `connection` outlives this
  ~X11PinnedWindow();
  X11PinnedWindow(const X11PinnedWindow&) = delete;
  X11PinnedWindow& operator=(const X11PinnedWindow&) = delete;

  [[nodiscard]] xcb_window_t id() const noexcept { return window_; }
  [[nodiscard]] X11Damage& damage() noexcept { return damage_; }

  // The window's pixels with its border; until it is shown anew or gets another size: then renew() it.
  [[nodiscard]] xcb_pixmap_t pixmap() const noexcept { return pixmap_; }
  void renew_pixmap();

 private:
  const X11Connection& connection_;
  xcb_window_t window_;
  X11Damage damage_;
  xcb_pixmap_t pixmap_ = 0;
};

}  // namespace telehug
