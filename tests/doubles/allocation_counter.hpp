// SPDX-License-Identifier: Apache-2.0
//
// Counts what this program takes from the heap, by whatever means: allocation_counter.cpp stands in front of malloc.
#pragma once

#include <cstdint>

namespace telehug {

// False under a sanitizer, which has a heap of its own: nothing is counted then.
[[nodiscard]] bool allocations_are_counted();

// Calls of malloc, calloc, realloc and their like since the program began, in all threads.
[[nodiscard]] std::uint64_t allocation_count();

}  // namespace telehug
