// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>

#include "screen_x11/x11_connection.hpp"

namespace telehug {

// WM_CLASS of telehug's own windows.
inline constexpr const char* x11_own_class = "telehug";

// Does no other window hide more than a tenth of `part_px` (px of the root window) of this window? telehug's own
// windows hide nothing, nor do those that let clicks through. Not in front if it is gone. Needs the extension SHAPE.
bool is_in_front(const X11Connection& connection, xcb_window_t window, const cv::Rect& part_px);

}  // namespace telehug
