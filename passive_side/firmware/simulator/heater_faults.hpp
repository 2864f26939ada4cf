// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "simulator/heated_patch.hpp"

namespace telehug {

// HEATER:WHAT or HEATER:WHAT@SECONDS (since power-on; 0 if left out), such as 0:open@2.5.
struct HeaterFaultOption {
  std::size_t heater = 0;
  HeaterBreak what{};
  double at_s = 0;
};

// Throws std::runtime_error that says what is wrong with it.
[[nodiscard]] HeaterFaultOption parse_heater_fault(const std::string& text);

}  // namespace telehug
