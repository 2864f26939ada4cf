// SPDX-License-Identifier: Apache-2.0
//
// A GPIO chip that is a folder: each of its files is a line of that name, whose content is its level in volts, so to
// say
// ("1" high, anything else low). Without buttons or wires: `echo 1 > DIR/stop` presses one, `cat DIR/power` reads
// an output. Whoever requests a line locks its file (flock(2)); what an output's file holds counts only while it is
// locked, since a real line is not driven, either, once its owner is dead. A file that is removed is a line that is
// lost.
#pragma once

#include <filesystem>

#include "gpio/line.hpp"

namespace telehug {

// Pull resistors mean nothing here. Changes are seen through inotify(7), each when it is read.
[[nodiscard]] Result<std::unique_ptr<GpioChip>> open_simulated_chip(const std::filesystem::path& folder);

}  // namespace telehug
