// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>

namespace telehug {

struct X11GrabberConfig {
  std::string display = {};  // empty: $DISPLAY
  std::string monitor = {};  // its name for RandR ("HDMI-1"); empty: the primary one, else the first
  std::string window = {};  // part of the title or of WM_CLASS of the chat's window, in upper or lower case; empty: the
                            // whole monitor
  std::optional<cv::Rect> region = {};  // px of the monitor; only this part of it, and of the window; none: all
};

}  // namespace telehug
