// SPDX-License-Identifier: Apache-2.0
//
// Signals as values read from a file descriptor (signalfd(2)): no code runs inside a handler.
#pragma once

#include <signal.h>

#include <optional>

#include "common/clock.hpp"

namespace telehug {

enum class SignalRequest {
  stop,    // SIGTERM, SIGINT
  reload,  // SIGHUP
};

class Signals {
 public:
  // Make it before any thread is started: threads inherit that these signals are held back. Also ignores SIGPIPE, so
  // that a reader who goes away is an error of a write and not the end of the daemon. Throws std::system_error.
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  // Readable when a signal has come.
  [[nodiscard]] int fd() const noexcept { return fd_; }

  // The oldest unread request; nothing if none came. Does not wait.
  [[nodiscard]] std::optional<SignalRequest> take() noexcept;

  // The same, but waits up to `longest`.
  [[nodiscard]] std::optional<SignalRequest> wait(Duration longest) noexcept;

 private:
  sigset_t before_{};
  int fd_ = -1;
};

}  // namespace telehug
