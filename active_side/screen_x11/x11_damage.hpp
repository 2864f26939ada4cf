// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xcb/damage.h>
#include <xcb/xfixes.h>

#include <opencv2/core/types.hpp>
#include <vector>

#include "screen_x11/x11_connection.hpp"

namespace telehug {

// Where a window was drawn in. Needs the extensions DAMAGE and XFIXES, both versions agreed upon.
class X11Damage {
 public:
  X11Damage(const X11Connection& connection, xcb_window_t window);  // `connection` outlives this
  ~X11Damage();
  X11Damage(const X11Damage&) = delete;
  X11Damage& operator=(const X11Damage&) = delete;

  // Notes what an event says of this window; false if it is about something else.
  bool note(const xcb_generic_event_t& event);

  // What was drawn in since the last call, px of the window; the first call returns all of it. Only where it touches
  // `watched_px` must the server be waited for.
  std::vector<cv::Rect> take(const cv::Rect& watched_px);

 private:
  const X11Connection& connection_;
  std::uint8_t first_event_ = 0;
  xcb_damage_damage_t damage_ = 0;
  xcb_xfixes_region_t parts_ = 0;
  cv::Rect noted_px_;  // spans what the events told of
};

}  // namespace telehug
