// SPDX-License-Identifier: Apache-2.0
#include "doubles/allocation_counter.hpp"

#include <atomic>
#include <cerrno>
#include <cstddef>

// GCC defines macros, clang has features.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TELEHUG_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TELEHUG_SANITIZED 1
#endif
#endif

namespace telehug {
namespace {
std::atomic<std::uint64_t> count{0};
}

#ifdef TELEHUG_SANITIZED
bool allocations_are_counted() {
  return false;
}
#else
bool allocations_are_counted() {
  return true;
}
#endif

std::uint64_t allocation_count() {
  return count.load(std::memory_order_relaxed);
}

}  // namespace telehug

#ifndef TELEHUG_SANITIZED
// The names are glibc's; operator new ends in malloc. Freeing stays glibc's own.
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t number, std::size_t size);       // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* pointer, std::size_t size);           // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT(bugprone-reserved-identifier)

void* malloc(std::size_t size) {
  telehug::count.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}

void* calloc(std::size_t number, std::size_t size) {
  telehug::count.fetch_add(1, std::memory_order_relaxed);
  return __libc_calloc(number, size);
}

void* realloc(void* pointer, std::size_t size) {
  telehug::count.fetch_add(1, std::memory_order_relaxed);
  return __libc_realloc(pointer, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  telehug::count.fetch_add(1, std::memory_order_relaxed);
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return memalign(alignment, size);
}

int posix_memalign(void** pointer, std::size_t alignment, std::size_t size) {
  *pointer = memalign(alignment, size);
  return *pointer == nullptr ? ENOMEM : 0;
}
}
#endif
