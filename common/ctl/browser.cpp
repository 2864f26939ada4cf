// SPDX-License-Identifier: Apache-2.0
#include "ctl/browser.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <thread>

#include "common/clock.hpp"

namespace telehug {

Status show_in_browser(const std::string& url) {
  // A session of its own: the browser outlives the terminal. What it says belongs to nobody.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string program = "xdg-open";
  std::string word = url;
  std::array<char*, 3> words{program.data(), word.data(), nullptr};
  pid_t pid = 0;
  const int code = posix_spawnp(&pid, program.c_str(), &actions, &attributes, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (code == ENOENT) return Error{"there is no xdg-open (package xdg-utils) that would find a browser"};
  if (code != 0) return Error{std::string("xdg-open can't be started: ") + std::strerror(code)};
  const Timestamp give_up = SteadyClock{}.now() + 2s;
  while (SteadyClock{}.now() < give_up) {
    int state = 0;
    if (waitpid(pid, &state, WNOHANG) == pid) {
      if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return Done{};
      return Error{"no browser could be started"};
    }
    std::this_thread::sleep_for(20ms);
  }
  return Done{};
}

}  // namespace telehug
