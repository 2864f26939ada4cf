// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace telehug {

// How often operator new ran in this program so far, in any thread. Link allocation_counter.cpp into the test.
[[nodiscard]] std::uint64_t allocations() noexcept;

}  // namespace telehug
