// SPDX-License-Identifier: Apache-2.0
//
// A chip of the kernel through libgpiod, version 1.6 (gpiod_chip_v1.cpp) or 2 (gpiod_chip_v2.cpp): whichever is
// installed where telehug is built.
#pragma once

#include "gpio/line.hpp"

namespace telehug {

[[nodiscard]] Result<std::unique_ptr<GpioChip>> open_gpiod_chip(const std::string& name);

}  // namespace telehug
