// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.hpp"
#include "gpio/panel_lines.hpp"

namespace telehug {

// [gpio] as the lines' own words.
[[nodiscard]] PanelOptions panel_options(const GpioConfig& config);

}  // namespace telehug
