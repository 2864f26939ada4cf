// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace telehug {

// An X server without a screen, on a display number of its own; ended with this object.
class Xvfb {
 public:
  // `screen` is WIDTHxHEIGHTxDEPTH; `options` are further ones of Xvfb.
  explicit Xvfb(std::string screen = "800x600x24", std::vector<std::string> options = {})
      : screen_(std::move(screen)), options_(std::move(options)) {
    start();
  }
  ~Xvfb() { stop(); }
  Xvfb(const Xvfb&) = delete;
  Xvfb& operator=(const Xvfb&) = delete;

  [[nodiscard]] const std::string& display() const noexcept { return display_; }  // ":7"

  // Ends the server; start() starts another one on the same display.
  void stop() {
    if (pid_ > 0) {
      kill(pid_, SIGTERM);
      waitpid(pid_, nullptr, 0);
      pid_ = 0;
    }
  }

  void start() {
    // With -terminate it also ends when a test that crashed has left it.
    std::vector<std::string> arguments{"Xvfb", "-screen",    "0",          screen_, "-nolisten",
                                       "tcp",  "-terminate", "-displayfd", "3"};
    if (!display_.empty()) arguments.insert(arguments.begin() + 1, display_);
    arguments.insert(arguments.end(), options_.begin(), options_.end());
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (auto& argument : arguments)
      pointers.push_back(argument.data());
    pointers.push_back(nullptr);

    std::array<int, 2> pipe_ends{};
    if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    // By way of another number: the pipe itself may be 3, and then the copy would close with the exec.
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], 9);
    posix_spawn_file_actions_adddup2(&actions, 9, 3);
    posix_spawn_file_actions_addclose(&actions, 9);
    const int error = posix_spawnp(&pid_, "Xvfb", &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[1]);
    if (error != 0) {
      pid_ = 0;
      close(pipe_ends[0]);
      throw std::runtime_error("Xvfb can't be started; install it with deploy/setup test");
    }
    const std::string number = read_line(pipe_ends[0]);
    close(pipe_ends[0]);
    if (number.empty()) {
      stop();
      throw std::runtime_error("Xvfb has started but names no display");
    }
    display_ = ":" + number;
  }

 private:
  static std::string read_line(int fd) {
    std::string line;
    pollfd ready{fd, POLLIN, 0};
    char letter = 0;
    while (poll(&ready, 1, 30'000) == 1 && ::read(fd, &letter, 1) == 1) {
      if (letter == '\n') return line;
      line += letter;
    }
    return {};
  }

  std::string screen_;
  std::vector<std::string> options_;
  pid_t pid_ = 0;
  std::string display_;
};

}  // namespace telehug
