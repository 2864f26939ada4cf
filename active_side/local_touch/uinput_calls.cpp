// SPDX-License-Identifier: Apache-2.0
#include "local_touch/uinput_calls.hpp"

#include <fcntl.h>
#include <libevdev/libevdev-uinput.h>
#include <linux/uinput.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>

namespace telehug {
namespace {

class KernelDevice final : public UinputDevice {
 public:
  explicit KernelDevice(int fd) : fd_(fd) {}
  ~KernelDevice() override {
    if (device_ != nullptr) libevdev_uinput_destroy(device_);
    ::close(fd_);
  }
  KernelDevice(const KernelDevice&) = delete;
  KernelDevice& operator=(const KernelDevice&) = delete;

  int create(const libevdev& description, const std::string& phys) {
    // libevdev sets all but this; before the device is made.
    if (ioctl(fd_, UI_SET_PHYS, phys.c_str()) < 0) return -errno;
    return libevdev_uinput_create_from_device(&description, fd_, &device_);
  }

  // The kernel takes as many events as fit into one call; a frame's are a few dozen.
  int write(std::span<const input_event> events) override {
    const ssize_t written = ::write(fd_, events.data(), events.size_bytes());
    if (written < 0) return -errno;
    return static_cast<std::size_t>(written) == events.size_bytes() ? 0 : -EIO;
  }

  [[nodiscard]] std::string node() const override {
    const char* node = libevdev_uinput_get_devnode(device_);
    return node == nullptr ? "" : node;
  }

 private:
  int fd_;
  libevdev_uinput* device_ = nullptr;
};

class KernelCalls final : public UinputCalls {
 public:
  int create(const libevdev& description, const std::string& phys, std::unique_ptr<UinputDevice>& device) override {
    const int fd = ::open("/dev/uinput", O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return -errno;
    auto made = std::make_unique<KernelDevice>(fd);
    const int code = made->create(description, phys);
    if (code == 0) device = std::move(made);
    return code;
  }
};

}  // namespace

UinputCalls& kernel_uinput_calls() {
  static KernelCalls calls;
  return calls;
}

}  // namespace telehug
