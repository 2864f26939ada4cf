// SPDX-License-Identifier: Apache-2.0
#include "capture/v4l2_calls.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace telehug {
namespace {

class KernelV4l2Calls final : public V4l2Calls {
 public:
  int open(const std::string& device) override {
    return repeated([&] { return ::open(device.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC); });
  }
  void close(int fd) override { ::close(fd); }
  int ioctl(int fd, unsigned long request, void* argument) override {
    return repeated([&] { return ::ioctl(fd, request, argument); });
  }
  void* map(int fd, std::size_t length, std::size_t offset) override {
    void* address = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, fd, static_cast<off_t>(offset));
    return address == MAP_FAILED ? nullptr : address;
  }
  void unmap(void* address, std::size_t length) override { ::munmap(address, length); }

  int wait(int fd, Duration timeout) override {
    const auto ns = std::max<std::chrono::nanoseconds::rep>(0, std::chrono::nanoseconds(timeout).count());
    const timespec time{static_cast<time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
    pollfd polled{fd, POLLIN, 0};
    const int ready = ::ppoll(&polled, 1, &time, nullptr);
    if (ready < 0) return errno == EINTR ? 0 : -errno;  // the caller looks at its deadline and waits again
    if ((polled.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) return -ENODEV;
    return ready;
  }

 private:
  template <typename Call>
  static int repeated(Call call) {
    while (true) {
      const int result = call();
      if (result >= 0) return result;
      if (errno != EINTR) return -errno;
    }
  }
};

}  // namespace

V4l2Calls& kernel_v4l2_calls() {
  static KernelV4l2Calls calls;
  return calls;
}

}  // namespace telehug
