// SPDX-License-Identifier: Apache-2.0
#include "daemon/pairing_run.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <string_view>

#include "common/clock.hpp"

namespace telehug {
namespace {

constexpr std::size_t longest_line = 65'536;
constexpr int look_ms = 50;  // how often it is looked whether it is to be ended
constexpr Duration patience = 2s;

struct Started {
  pid_t pid = 0;
  int output = -1;  // both streams
  std::string problem = {};
};

Started start(std::vector<std::string>& command) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return {.problem = std::strerror(errno)};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  std::vector<char*> words;
  words.reserve(command.size() + 1);
  for (std::string& word : command)
    words.push_back(word.data());
  words.push_back(nullptr);
  Started started{.output = ends[0]};
  const int failed = posix_spawn(&started.pid, words.front(), &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (failed == 0) return started;
  close(ends[0]);
  return {.problem = std::strerror(failed)};
}

// Objects are news; of sentences the last one says why it failed.
void take_line(std::string line, const PairingRun::Handlers& handlers, std::string& sentence) {
  const auto object = nlohmann::json::parse(line, nullptr, false);
  if (object.is_object()) return handlers.told(object);
  constexpr std::string_view speaker = "telehug: ";
  if (line.starts_with(speaker)) line.erase(0, speaker.size());
  if (!line.empty()) sentence = std::move(line);
}

}  // namespace

PairingRun::PairingRun(std::vector<std::string> command, Handlers handlers)
    : handlers_(std::move(handlers)),
      thread_([this, words = std::move(command)]() mutable { run(std::move(words)); }) {}

PairingRun::~PairingRun() {
  cancel();
  thread_.join();
}

void PairingRun::run(std::vector<std::string> command) {
  const Started program = start(command);
  if (program.output < 0) return handlers_.is_over(fmt::format("can't run {}: {}", command.front(), program.problem));
  const SteadyClock clock;
  std::optional<Timestamp> asked_to_end;
  std::string text;
  std::string sentence;
  for (;;) {
    if (cancelled_ && !asked_to_end) {
      asked_to_end = clock.now();
      kill(program.pid, SIGTERM);
    }
    if (asked_to_end && clock.now() - *asked_to_end > patience) break;
    pollfd readable{program.output, POLLIN, 0};
    if (poll(&readable, 1, look_ms) <= 0) continue;
    std::array<char, 4096> part{};
    const ssize_t size = read(program.output, part.data(), part.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) break;
    text.append(part.data(), static_cast<std::size_t>(size));
    for (std::size_t end = 0; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1))
      take_line(text.substr(0, end), handlers_, sentence);
    if (text.size() > longest_line) break;
  }
  close(program.output);
  kill(program.pid, SIGKILL);  // has closed its output, or would not end
  int state = 0;
  while (waitpid(program.pid, &state, 0) < 0 && errno == EINTR) {
  }
  const bool well = WIFEXITED(state) && WEXITSTATUS(state) == 0;
  handlers_.is_over(well ? "" : !sentence.empty() ? sentence : "the pairing broke off");
}

}  // namespace telehug
