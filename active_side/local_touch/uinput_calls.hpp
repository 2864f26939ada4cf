// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/input.h>

#include <memory>
#include <span>
#include <string>

struct libevdev;

namespace telehug {

// A virtual input device of the kernel. It vanishes with this.
class UinputDevice {
 public:
  virtual ~UinputDevice() = default;

  // All or nothing; 0 or a negative errno.
  virtual int write(std::span<const input_event> events) = 0;

  // "/dev/input/event7"; empty if unknown.
  [[nodiscard]] virtual std::string node() const = 0;
};

// The way to /dev/uinput: the seam at which tests put a kernel of their own.
class UinputCalls {
 public:
  virtual ~UinputCalls() = default;

  // Makes a device like `description`; `phys` is its physical path, for udev rules. 0 or a negative errno.
  virtual int create(const libevdev& description, const std::string& phys, std::unique_ptr<UinputDevice>& device) = 0;
};

// The kernel's.
UinputCalls& kernel_uinput_calls();

}  // namespace telehug
