// SPDX-License-Identifier: Apache-2.0
#include "child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

namespace telehug {
namespace {

// In the child, between fork and exec: only what signal-safety(7) allows. Its signals are as at a shell's, whatever is
// held back here.
[[noreturn]] void become(char* const* arguments, const char* log, pid_t parent) {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it ended before it could be watched
  dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  dup2(open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644), STDOUT_FILENO);
  dup2(STDOUT_FILENO, STDERR_FILENO);
  execv(arguments[0], arguments);
  _exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& log) {
  std::vector<std::string> arguments = command;
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments)
    pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  const pid_t parent = getpid();
  pid_ = access(command.front().c_str(), X_OK) == 0 ? fork() : -1;
  if (pid_ < 0) throw std::runtime_error(command.front() + " can't be started: is it built?");
  if (pid_ == 0) become(pointers.data(), log.c_str(), parent);
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
