// SPDX-License-Identifier: Apache-2.0
//
// Loaded into a program by LD_PRELOAD: its wall clock, and no other clock of it, differs from this PC's by as many
// nanoseconds as the file says that the variable TELEHUG_TEST_WALL_CLOCK names. The test may change that at any time.
// Waits until a time of the wall clock go by the kernel's; telehug and Fast DDS wait by the steady one.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

using Offset = std::atomic<std::int64_t>;

const Offset* mapped_offset() {
  const char* file = getenv("TELEHUG_TEST_WALL_CLOCK");
  const int descriptor = file == nullptr ? -1 : open(file, O_RDONLY | O_CLOEXEC);
  void* page = mmap(nullptr, sizeof(Offset), PROT_READ, MAP_SHARED, descriptor, 0);
  if (page == MAP_FAILED) abort();  // a test with the clock as it is would show nothing
  close(descriptor);
  return static_cast<const Offset*>(page);
}

std::int64_t offset_ns() {
  static const Offset* offset = mapped_offset();
  return *offset;
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* now) noexcept {
  using Call = int (*)(clockid_t, timespec*);
  static const auto real = reinterpret_cast<Call>(dlsym(RTLD_NEXT, "clock_gettime"));
  const int result = real(clock, now);
  if (result != 0 || (clock != CLOCK_REALTIME && clock != CLOCK_REALTIME_COARSE)) return result;
  const std::int64_t shifted = now->tv_sec * second_ns + now->tv_nsec + offset_ns();
  now->tv_sec = shifted / second_ns;
  now->tv_nsec = shifted % second_ns;
  return 0;
}

extern "C" int gettimeofday(timeval* now, void* /*zone*/) noexcept {
  timespec precise{};
  clock_gettime(CLOCK_REALTIME, &precise);
  *now = {precise.tv_sec, precise.tv_nsec / 1000};
  return 0;
}

extern "C" time_t time(time_t* now) noexcept {
  timespec precise{};
  clock_gettime(CLOCK_REALTIME, &precise);
  if (now != nullptr) *now = precise.tv_sec;
  return precise.tv_sec;
}
