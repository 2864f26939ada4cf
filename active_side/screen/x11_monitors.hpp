// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "screen/x11_connection.hpp"

namespace telehug {

struct X11Monitor {
  std::string name;  // RandR's: "HDMI-1"
  bool primary = false;
  cv::Rect place_px;  // px of the root window, within it; not empty
};

// The monitors that are on. Needs RandR 1.5.
std::vector<X11Monitor> list_x11_monitors(const X11Connection& connection);

// The one of this name; without a name the primary one, else the first. Fails with a list of what there is.
Result<X11Monitor> choose_x11_monitor(const std::vector<X11Monitor>& monitors, const std::string& name);

}  // namespace telehug
