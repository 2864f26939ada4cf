// SPDX-License-Identifier: Apache-2.0
#include "gpio/gpiod_chip.hpp"
#include "gpio/line.hpp"
#include "gpio/simulated_chip.hpp"

namespace telehug {

Result<std::unique_ptr<GpioChip>> open_chip(const std::string& name) {
  constexpr std::string_view simulated = "simulated:";
  if (name.starts_with(simulated)) return open_simulated_chip(name.substr(simulated.size()));
  return open_gpiod_chip(name);
}

}  // namespace telehug
