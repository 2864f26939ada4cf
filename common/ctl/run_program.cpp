// SPDX-License-Identifier: Apache-2.0
#include "ctl/run_program.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace telehug {
namespace {

constexpr std::size_t output_bytes_max = 1U << 20U;

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (std::string& word : words)
    result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> own_variables_in_the_c_locale() {
  std::vector<std::string> variables{"LC_ALL=C"};
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (std::strncmp(*variable, "LC_ALL=", 7) != 0) variables.emplace_back(*variable);
  return variables;
}

// Until the program closes its output, at the latest when the time is over: false then.
bool read_all(int fd, Timestamp deadline, std::string& output) {
  const SteadyClock clock;
  std::array<char, 4096> part{};
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - clock.now());
    if (left.count() <= 0) return false;
    pollfd readable{fd, POLLIN, 0};
    const int ready = poll(&readable, 1, static_cast<int>(left.count()));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    const ssize_t size = read(fd, part.data(), part.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return true;
    output.append(part.data(), std::min(static_cast<std::size_t>(size), output_bytes_max - output.size()));
  }
}

}  // namespace

Result<ProgramRun> run_program(std::vector<std::string> command, Duration longest, const std::string& missing) {
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
    return Error{fmt::format("can't run {}: {}", command.front(), std::strerror(errno))};
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
  std::vector<std::string> variables = own_variables_in_the_c_locale();
  pid_t pid = 0;
  const int problem = posix_spawnp(&pid, command.front().c_str(), &actions, nullptr, pointers(command).data(),
                                   pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  if (problem != 0) {
    close(pipe_ends[0]);
    if (problem == ENOENT) return Error{missing};
    return Error{fmt::format("can't run {}: {}", command.front(), std::strerror(problem))};
  }
  ProgramRun run;
  run.timed_out = !read_all(pipe_ends[0], SteadyClock{}.now() + longest, run.output);
  if (run.timed_out) kill(pid, SIGKILL);
  close(pipe_ends[0]);
  int state = 0;
  while (waitpid(pid, &state, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(state)) run.code = WEXITSTATUS(state);
  return run;
}

}  // namespace telehug
