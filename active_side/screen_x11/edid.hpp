// SPDX-License-Identifier: Apache-2.0
//
// How large a monitor says it is: VESA E-EDID 1.4 (the first block; the same in 1.3).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace telehug {

// Width and height of what a monitor shows.
struct MonitorMm {
  double width_mm = 0;
  double height_mm = 0;

  constexpr bool operator==(const MonitorMm&) const = default;
};

// Any bytes may be given. To a millimetre where the preferred timing tells it (bytes 66 to 68) and agrees with the
// whole centimetres of the display's own parameters (bytes 21 and 22); else those. Nothing if it is no EDID, or
// damaged, or the monitor does not know (a projector), or says what no monitor measures: some tell the aspect, 16 x 9.
[[nodiscard]] std::optional<MonitorMm> monitor_size_in_edid(std::span<const std::uint8_t> edid);

}  // namespace telehug
