// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "screen_x11/edid.hpp"
#include "screen_x11/x11_monitors.hpp"

namespace telehug {

enum class MonitorSizeFrom { edid, randr, nowhere };

struct SizedMonitor {
  X11Monitor monitor;
  MonitorMm size;  // as the monitor stands: turned, if its picture is; 0 x 0 from nowhere
  MonitorSizeFrom from = MonitorSizeFrom::nowhere;
};

// The monitors that are on, with how large they are: as the monitor itself says (RandR's property EDID), else as the X
// server does, which may have made it up from 96 pixels an inch. Needs RandR 1.5.
[[nodiscard]] std::vector<SizedMonitor> list_sized_x11_monitors(const X11Connection& connection);

[[nodiscard]] const char* name_of(MonitorSizeFrom from) noexcept;

}  // namespace telehug
