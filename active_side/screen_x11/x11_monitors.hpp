// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "screen_x11/x11_connection.hpp"

namespace telehug {

struct X11Monitor {
  std::string name;  // RandR's: "HDMI-1"
  bool primary = false;
  cv::Rect place_px;           // px of the root window, within it; not empty
  std::uint32_t width_mm = 0;  // as the server says; 0: it does not know
  std::uint32_t height_mm = 0;
  std::vector<std::uint32_t> outputs = {};  // RandR's, that show it
};

// The monitors that are on. Needs RandR 1.5.
std::vector<X11Monitor> list_x11_monitors(const X11Connection& connection);

// The one of this name; without a name the primary one, else the first. Fails with a list of what there is.
Result<X11Monitor> choose_x11_monitor(const std::vector<X11Monitor>& monitors, const std::string& name);

// Notices that monitors are plugged in, moved or switched. Needs RandR 1.5.
class X11MonitorNews {
 public:
  explicit X11MonitorNews(const X11Connection& connection) : connection_(connection) {}  // which outlives this

  // From now on events of that come through the connection, with those of the root window in `further_events` (a mask).
  void ask_for(std::uint32_t further_events);
  [[nodiscard]] bool has(const xcb_generic_event_t& event) const noexcept;

 private:
  const X11Connection& connection_;
  int first_event_ = 0;
};

}  // namespace telehug
