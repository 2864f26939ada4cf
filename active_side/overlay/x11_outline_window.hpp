// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "common/result.hpp"
#include "screen_x11/x11_connection.hpp"
#include "screen_x11/x11_monitors.hpp"

namespace telehug {

// A window that consists of lines and lets clicks through, as long as one connection to the server lasts.
class X11OutlineWindow {
 public:
  // An unmapped one. Fails if the display can't be used.
  static Result<std::unique_ptr<X11OutlineWindow>> create(const std::string& display, const std::string& monitor);

  [[nodiscard]] bool broken() const noexcept { return connection_.broken(); }
  [[nodiscard]] const std::string& display() const noexcept { return connection_.display(); }

  // Learns what happened to the monitors and the window since the last call; fails if there is no such monitor.
  Status follow();
  [[nodiscard]] const cv::Rect& monitor_px() const noexcept { return monitor_px_; }  // of the root window

  // The lines of an outline, px of the monitor. Does nothing if they are shown like this already.
  void show(const std::vector<cv::Rect>& lines_px, std::uint32_t rgb, Timestamp now);
  void hide();

 private:
  X11OutlineWindow(X11Connection connection, std::string monitor);

  void make_window();
  std::uint32_t colour(std::uint32_t rgb);

  X11Connection connection_;
  std::string monitor_;  // as it is asked for
  X11MonitorNews news_;
  bool monitors_stale_ = true;
  cv::Rect monitor_px_;
  xcb_window_t window_ = 0;
  bool obscured_ = false;
  Timestamp raised_;
  std::vector<cv::Rect> shown_px_;  // px of the root window; empty: unmapped
  cv::Rect shown_whole_px_;         // spans them
  std::uint32_t shown_rgb_ = 0;
};

}  // namespace telehug
