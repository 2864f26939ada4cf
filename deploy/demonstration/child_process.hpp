// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/clock.hpp"

namespace telehug {

// A program that runs beside this one, its output in a file. It is asked to end, then made to, when this object goes,
// and killed when the thread that started it ends in any way: a daemon left behind would take the next simulated jacket
// that gets the same terminal.
class ChildProcess {
 public:
  // Throws std::runtime_error if it can't be started.
  ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& log);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  [[nodiscard]] pid_t pid() const noexcept { return pid_; }
  [[nodiscard]] bool runs();

  // SIGTERM, and SIGKILL if it has not ended in time. The exit code; nothing if a signal ended it.
  std::optional<int> end(Duration longest = 5s);
  void kill_now();

 private:
  void reap(bool wait);

  pid_t pid_ = 0;
  bool ended_ = false;
  int state_ = 0;  // as waitpid() tells it
};

}  // namespace telehug
