// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace telehug {

// A program that a test needs beside itself; ended with this object. It hears nothing; what it says can be read.
class ChildProgram {
 public:
  // `environment`: "NAME=value", in place of the test's own variables of these names.
  ChildProgram(std::vector<std::string> command, const std::vector<std::string>& environment = {}) {
    std::array<int, 2> pipe_ends{};
    if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be made");
    output_ = pipe_ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    std::vector<char*> words = pointers(command);
    std::vector<std::string> variables = environment;
    for (char** variable = environ; *variable != nullptr; ++variable)
      if (!is_among(environment, *variable)) variables.emplace_back(*variable);
    std::vector<char*> settings = pointers(variables);
    const int code = posix_spawnp(&pid_, words[0], &actions, nullptr, words.data(), settings.data());
    posix_spawn_file_actions_destroy(&actions);
    ::close(pipe_ends[1]);
    if (code == 0) return;
    ::close(output_);
    throw std::runtime_error("the test needs the program " + command[0] + ", which can't be started (" +
                             std::strerror(code) + "); run deploy/setup test");
  }
  ~ChildProgram() {
    end();
    ::close(output_);
  }
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  [[nodiscard]] pid_t pid() const noexcept { return pid_; }

  void end() {
    if (pid_ == 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }

  // Waits until it ends by itself: its exit code, or -1.
  int wait_for_end() {
    int state = 0;
    const bool ended = pid_ != 0 && ::waitpid(pid_, &state, 0) == pid_;
    pid_ = 0;
    return ended && WIFEXITED(state) ? WEXITSTATUS(state) : -1;
  }

  // Waits for the next line that it prints; what came until its end if there is no further one.
  std::string read_line() const {
    std::string line;
    for (char letter = 0; ::read(output_, &letter, 1) == 1 && letter != '\n';)
      line += letter;
    return line;
  }

  // The next line that it prints; nothing if that takes longer or it has ended. Not to be mixed with the above.
  std::optional<std::string> read_line_within(std::chrono::milliseconds longest) {
    const auto give_up = std::chrono::steady_clock::now() + longest;
    for (;;) {
      if (const std::size_t end = unread_.find('\n'); end != std::string::npos) {
        std::string line = unread_.substr(0, end);
        unread_.erase(0, end + 1);
        return line;
      }
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(give_up - std::chrono::steady_clock::now());
      pollfd output{output_, POLLIN, 0};
      if (::poll(&output, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0))) != 1) return std::nullopt;
      std::array<char, 4096> part{};
      const ssize_t size = ::read(output_, part.data(), part.size());
      if (size <= 0) return std::nullopt;
      unread_.append(part.data(), static_cast<std::size_t>(size));
    }
  }

 private:
  static std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> result;
    result.reserve(words.size() + 1);
    for (std::string& word : words)
      result.push_back(word.data());
    result.push_back(nullptr);
    return result;
  }
  static bool is_among(const std::vector<std::string>& environment, const std::string& variable) {
    const std::string name = variable.substr(0, variable.find('=') + 1);
    for (const std::string& setting : environment)
      if (setting.starts_with(name)) return true;
    return false;
  }

  pid_t pid_ = 0;
  int output_ = -1;
  std::string unread_;
};

}  // namespace telehug
