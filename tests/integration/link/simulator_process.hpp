// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace telehug {

// A folder of its own for one test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string path = std::filesystem::temp_directory_path() / "telehug-test-XXXXXX";
    if (mkdtemp(path.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = path;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

struct PinLine {
  std::int64_t monotonic_ns = 0;
  std::uint64_t cycle = 0;
  int channel = 0;
  bool on = false;
};

// The complete lines of a --pins file.
inline std::vector<PinLine> read_pins(const std::filesystem::path& file) {
  std::vector<PinLine> lines;
  std::ifstream stream(file);
  for (std::string text; std::getline(stream, text) && !stream.eof();) {
    PinLine line;
    std::array<char, 4> state{};
    if (std::sscanf(text.c_str(), "%ld,%lu,%d,%3s", &line.monotonic_ns, &line.cycle, &line.channel, state.data()) !=
        4) {
      throw std::runtime_error("unreadable line in the pin log: " + text);
    }
    line.on = std::string_view(state.data()) == "on";
    lines.push_back(line);
  }
  return lines;
}

// telehug-jacket-sim as a child, ready to be talked to; ended with this object.
class SimulatorProcess {
 public:
  explicit SimulatorProcess(std::vector<std::string> arguments) {
    std::array<int, 2> pipe_ends{};
    if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    std::string program = TELEHUG_BIN "/telehug-jacket-sim";
    std::vector<char*> pointers{program.data()};
    for (auto& argument : arguments)
      pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const int error = posix_spawn(&pid_, pointers[0], &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[1]);
    output_ = fdopen(pipe_ends[0], "r");
    if (error != 0) throw std::runtime_error("can't start telehug-jacket-sim");
    first_line_ = read_line();
  }
  ~SimulatorProcess() {
    end(SIGTERM);
    std::fclose(output_);
  }
  SimulatorProcess(const SimulatorProcess&) = delete;
  SimulatorProcess& operator=(const SimulatorProcess&) = delete;

  // Waits for the next line of its output; empty at the end.
  std::string read_line() {
    std::array<char, 256> line{};
    if (std::fgets(line.data(), line.size(), output_) == nullptr) return {};
    std::string text = line.data();
    if (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
  }

  [[nodiscard]] const std::string& first_line() const { return first_line_; }
  void signal(int number) const { kill(pid_, number); }

  // Returns the wait status, 0 if it had ended before.
  int end(int number) {
    if (pid_ == 0) return 0;
    int status = 0;
    kill(pid_, number);
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return status;
  }

 private:
  pid_t pid_ = 0;
  std::FILE* output_ = nullptr;
  std::string first_line_;
};

}  // namespace telehug
