// SPDX-License-Identifier: Apache-2.0
#include "child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <stdexcept>
#include <thread>

namespace telehug {
namespace {

struct SpawnSettings {
  posix_spawnattr_t attributes{};
  posix_spawn_file_actions_t files{};

  // The child's signals are as at a shell's, whatever is held back here.
  explicit SpawnSettings(const std::filesystem::path& log) {
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  }
  ~SpawnSettings() {
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& log) {
  std::vector<std::string> arguments = command;
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments)
    pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  const SpawnSettings settings(log);
  if (posix_spawn(&pid_, command.front().c_str(), &settings.files, &settings.attributes, pointers.data(), environ) !=
      0) {
    throw std::runtime_error(command.front() + " can't be started: is it built?");
  }
}

ChildProcess::~ChildProcess() {
  (void)end();
}

bool ChildProcess::runs() {
  reap(false);
  return !ended_;
}

void ChildProcess::reap(bool wait) {
  if (!ended_ && waitpid(pid_, &state_, wait ? 0 : WNOHANG) == pid_) ended_ = true;
}

void ChildProcess::kill_now() {
  if (!runs()) return;
  kill(pid_, SIGKILL);
  reap(true);
}

std::optional<int> ChildProcess::end(Duration longest) {
  if (runs()) kill(pid_, SIGTERM);
  const auto deadline = std::chrono::steady_clock::now() + longest;
  while (runs() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(5ms);
  kill_now();
  return WIFEXITED(state_) ? std::optional(WEXITSTATUS(state_)) : std::nullopt;
}

}  // namespace telehug
