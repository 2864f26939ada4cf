// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

namespace telehug {

// Answers ioctl() in place of the kernel, for whatever the handler does not leave to it (by answering nothing). For
// programs that link ioctl_double.cpp; one thread.
class IoctlDouble {
 public:
  using Handler = std::function<std::optional<int>(int fd, unsigned long request, void* argument)>;

  explicit IoctlDouble(Handler handler);
  ~IoctlDouble();
  IoctlDouble(const IoctlDouble&) = delete;
  IoctlDouble& operator=(const IoctlDouble&) = delete;
};

}  // namespace telehug
