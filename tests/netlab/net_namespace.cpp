// SPDX-License-Identifier: Apache-2.0
#include "netlab/net_namespace.hpp"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <system_error>

namespace telehug {
namespace {

int present_network() {
  const int descriptor = open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "this thread's network can't be named");
  return descriptor;
}

// A thread that is left in the wrong network would make every later test err.
void return_to(int network) {
  if (setns(network, CLONE_NEWNET) != 0) std::terminate();
  close(network);
}

}  // namespace

NetNamespace::NetNamespace() {
  const int before = present_network();
  if (unshare(CLONE_NEWNET) != 0) {
    const int code = errno;
    close(before);
    throw std::system_error(code, std::generic_category(), "a network namespace can't be made");
  }
  descriptor_ = open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
  return_to(before);
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "a network namespace can't be named");
}

NetNamespace::~NetNamespace() {
  close(descriptor_);
}

InsideNamespace::InsideNamespace(const NetNamespace& network) : before_(present_network()) {
  if (setns(network.descriptor(), CLONE_NEWNET) == 0) return;
  const int code = errno;
  close(before_);
  throw std::system_error(code, std::generic_category(), "a network namespace can't be entered");
}

InsideNamespace::~InsideNamespace() {
  return_to(before_);
}

}  // namespace telehug
