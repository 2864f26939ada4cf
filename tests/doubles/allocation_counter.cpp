// SPDX-License-Identifier: Apache-2.0
#include "doubles/allocation_counter.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::uint64_t> count{0};
}

namespace telehug {
std::uint64_t allocations() noexcept {
  return count;
}
}  // namespace telehug

// The other forms of new and delete (arrays, nothrow, sized) end in these two.
void* operator new(std::size_t size) {
  ++count;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
