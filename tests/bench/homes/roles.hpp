// SPDX-License-Identifier: Apache-2.0
//
// What the benchmark's other processes do until they are killed.
#pragma once

#include "bench/homes/touch_ways.hpp"

namespace telehug {

[[noreturn]] void send_touches(Way way, const Meeting& meeting, int rate_hz);
// Writes every arrival to that file.
[[noreturn]] void note_touches(Way way, const Meeting& meeting, const std::filesystem::path& log);

}  // namespace telehug
