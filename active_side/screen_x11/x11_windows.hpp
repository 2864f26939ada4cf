// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "screen_x11/x11_connection.hpp"

namespace telehug {

struct X11WindowPlace {
  cv::Rect inside_px;  // what the program draws in, px of the root window; may reach beyond it
  int border_px = 0;   // that the server draws around that
  std::uint8_t depth = 0;
  xcb_visualid_t visual = 0;
  bool shown = false;  // neither unmapped nor minimised nor on another desktop; it may be covered all the same
};

// Finds the windows that programs have opened on a display, with a window manager or without. Their titles are
// compared, never kept.
class X11Windows {
 public:
  explicit X11Windows(const X11Connection& connection);  // which outlives this

  // Windows of programs with `text` in their title or class, topmost first; upper and lower case are the same (of
  // ASCII).
  [[nodiscard]] std::vector<xcb_window_t> named(const std::string& text) const;

  // None if the window is gone.
  [[nodiscard]] std::optional<X11WindowPlace> place(xcb_window_t window) const;

  // The property of the root window that changes when the window manager opens, closes or restacks a window.
  [[nodiscard]] xcb_atom_t stacking() const noexcept { return stacking_; }

 private:
  [[nodiscard]] std::vector<xcb_window_t> topmost_first() const;

  const X11Connection& connection_;
  xcb_atom_t stacking_ = 0;
  xcb_atom_t utf8_title_ = 0;
  xcb_atom_t wm_state_ = 0;
  xcb_atom_t net_state_ = 0;
  xcb_atom_t hidden_ = 0;
};

}  // namespace telehug
