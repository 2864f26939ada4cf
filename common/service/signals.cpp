// SPDX-License-Identifier: Apache-2.0
#include "service/signals.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace telehug {

Signals::Signals() {
  sigset_t wanted;
  sigemptyset(&wanted);
  for (const int number : {SIGTERM, SIGINT, SIGHUP})
    sigaddset(&wanted, number);
  if (const int problem = pthread_sigmask(SIG_BLOCK, &wanted, &before_); problem != 0) {
    throw std::system_error(problem, std::generic_category(), "can't hold back signals");
  }
  fd_ = signalfd(-1, &wanted, SFD_NONBLOCK | SFD_CLOEXEC);
  if (fd_ < 0) {
    const int problem = errno;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    throw std::system_error(problem, std::generic_category(), "can't receive signals");
  }
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, nullptr);
}

Signals::~Signals() {
  // What came and was not read must not end the process on the way out.
  while (take()) {
  }
  close(fd_);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

std::optional<SignalRequest> Signals::take() noexcept {
  signalfd_siginfo info{};
  if (read(fd_, &info, sizeof info) != static_cast<ssize_t>(sizeof info)) return std::nullopt;
  return info.ssi_signo == static_cast<unsigned>(SIGHUP) ? SignalRequest::reload : SignalRequest::stop;
}

std::optional<SignalRequest> Signals::wait(Duration longest) noexcept {
  pollfd descriptor{fd_, POLLIN, 0};
  const auto ms = std::chrono::ceil<std::chrono::milliseconds>(std::max(longest, Duration::zero())).count();
  poll(&descriptor, 1, static_cast<int>(std::min<long>(ms, 1'000'000)));
  return take();
}

}  // namespace telehug
