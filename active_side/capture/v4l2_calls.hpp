// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "common/clock.hpp"

namespace telehug {

// The system calls through which a V4L2 camera is used: the seam at which tests put a camera of their own. All of them
// return a negative errno on failure and are repeated when a signal interrupts them.
class V4l2Calls {
 public:
  virtual ~V4l2Calls() = default;

  virtual int open(const std::string& device) = 0;  // for reading and writing, not blocking; returns the descriptor
  virtual void close(int fd) = 0;
  virtual int ioctl(int fd, unsigned long request, void* argument) = 0;

  // Maps a buffer of the device; nullptr on failure.
  virtual void* map(int fd, std::size_t length, std::size_t offset) = 0;
  virtual void unmap(void* address, std::size_t length) = 0;

  // Waits until the device has a picture: 1; 0: it has none after `timeout`; -ENODEV: poll() says that the device is
  // gone or stopped. A negative fd only waits.
  virtual int wait(int fd, Duration timeout) = 0;
};

// The kernel's.
V4l2Calls& kernel_v4l2_calls();

}  // namespace telehug
