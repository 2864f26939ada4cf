// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "common/units.hpp"
#include "screen_x11/x11_connection.hpp"
#include "screen_x11/x11_damage.hpp"
#include "screen_x11/x11_grabber_config.hpp"
#include "screen_x11/x11_monitors.hpp"
#include "screen_x11/x11_pinned_window.hpp"
#include "screen_x11/x11_pixels.hpp"
#include "screen_x11/x11_windows.hpp"

namespace telehug {

// What is looked at now.
struct X11View {
  xcb_window_t window = 0;  // the root, or the pinned one
  cv::Rect part_px;         // of that window; not empty
  cv::Point origin_px;      // where the part's top-left corner lies on the monitor
  ImageSize monitor;
  std::optional<bool> in_front;  // none: no window is pinned
};

// The monitor or window that is watched, as long as one connection to the server lasts.
class X11Watch {
 public:
  // Fails if the server can't be reached, lacks something, or draws in a form that can't be read.
  static Result<std::unique_ptr<X11Watch>> connect(const X11GrabberConfig& config);

  [[nodiscard]] bool broken() const noexcept { return connection_.broken(); }
  [[nodiscard]] const std::string& display() const noexcept { return connection_.display(); }

  // Finds the monitor and the window; only where something was moved since the last call does that ask the server.
  Result<X11View> look();

  // Makes the next look() search anew.
  void forget_place() noexcept { places_stale_ = true; }

  // What was drawn in since the last call, px of the window that look() found. Empty if the view
  // was not touched.
  std::vector<cv::Rect> take_damage();

  // The pixels of the view that look() returned last: CV_8UC4, B G R and an undefined byte, valid until the next
  // call. Empty if they can't be read, for example since the window has just gone.
  cv::Mat read();

 private:
  X11Watch(X11Connection connection, const X11GrabberConfig& config);

  Status start();
  void note(const xcb_generic_event_t& event);
  Status find_monitor();
  Status find_window();
  Status place_view(const X11WindowPlace& place);
  Status lose_window(std::string why);

  X11Connection connection_;
  X11GrabberConfig config_;
  X11Pixels pixels_;
  X11Windows windows_;
  X11MonitorNews monitor_news_;
  bool monitors_stale_ = true;
  bool places_stale_ = true;  // of windows
  std::string monitor_name_;
  cv::Rect monitor_px_;                   // of the root window
  cv::Rect area_px_;                      // the part of it to look at, px of the root window
  std::optional<X11Damage> root_damage_;  // if no window is to be pinned
  std::optional<X11PinnedWindow> pinned_;
  bool was_found_ = false;
  int border_px_ = 0;  // of the pinned window
  X11View view_;
};

}  // namespace telehug
