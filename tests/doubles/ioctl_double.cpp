// SPDX-License-Identifier: Apache-2.0
#include "doubles/ioctl_double.hpp"

#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdarg>

namespace telehug {
namespace {

IoctlDouble::Handler& current() {
  static IoctlDouble::Handler handler;
  return handler;
}

}  // namespace

IoctlDouble::IoctlDouble(Handler handler) {
  current() = std::move(handler);
}
IoctlDouble::~IoctlDouble() {
  current() = nullptr;
}

}  // namespace telehug

// In place of the C library's.
extern "C" int ioctl(int fd, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (auto& handler = telehug::current()) {
    if (const auto answer = handler(fd, request, argument)) return *answer;
  }
  return static_cast<int>(syscall(SYS_ioctl, fd, request, argument));
}
