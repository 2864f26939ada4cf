// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "common/messages.hpp"

namespace telehug {

// Touches are counted, not logged; only [log] level = "debug" tells of each where it begins and ends, what became of
// it, and with whom ("": nobody in particular). For housekeeping threads.
void log_touch(std::string_view outcome, Phase phase, std::uint32_t contact, std::uint16_t box, std::string_view peer);

}  // namespace telehug
