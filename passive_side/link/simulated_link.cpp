// SPDX-License-Identifier: Apache-2.0
#include "link/simulated_link.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "wire/serial_port.hpp"

namespace telehug {
namespace {

std::filesystem::path program_beside_this() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path() / "telehug-jacket-sim";
}

std::filesystem::path make_private_folder() {
  std::string path = std::filesystem::temp_directory_path() / "telehug-jacket-XXXXXX";
  if (mkdtemp(path.data()) == nullptr) {
    throw std::runtime_error("can't make a folder for the simulated jacket in " +
                             std::filesystem::temp_directory_path().string());
  }
  return path;
}

// Fills in what was left open; makes the private folder only if it is needed.
SimulatorOptions complete(SimulatorOptions options, std::filesystem::path& private_folder) {
  if (options.program.empty()) options.program = program_beside_this();
  if (access(options.program.c_str(), X_OK) != 0) {
    throw std::runtime_error("there is no simulated jacket at " + options.program.string() +
                             ": build telehug-jacket-sim, or name it");
  }
  if (options.link.empty()) {
    private_folder = make_private_folder();
    options.link = private_folder / "jacket";
  }
  return options;
}

// The child gets the signals that we may have blocked, and no output but its complaints.
struct SpawnSettings {
  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};

  SpawnSettings() {
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnSettings() {
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
};

}  // namespace

SimulatedLink::SimulatedLink(SimulatorOptions options, std::unique_ptr<Conversation> conversation)
    : options_(complete(std::move(options), private_folder_)),
      wire_(std::make_unique<SerialOpener>(options_.link, default_baud), std::move(conversation)) {
  start();
}

SimulatedLink::~SimulatedLink() {
  if (child_ != 0) {
    kill(child_, SIGTERM);
    waitpid(child_, nullptr, 0);
  }
  std::error_code ignored;
  if (!private_folder_.empty()) std::filesystem::remove_all(private_folder_, ignored);
}

void SimulatedLink::poll(Timestamp now) {
  reap(now);
  if (child_ == 0 && now >= start_at_) {
    start_at_ = now + restart_pause;
    start();
  }
  wire_.poll(now);
}

void SimulatedLink::start() {
  std::vector<std::string> arguments{options_.program, "--link", options_.link};
  if (!options_.board.empty()) arguments.insert(arguments.end(), {"--board", options_.board});
  if (!options_.firmware.empty()) arguments.insert(arguments.end(), {"--firmware", options_.firmware});
  if (!options_.pins.empty()) arguments.insert(arguments.end(), {"--pins", options_.pins});
  if (options_.dies_with_this_program) arguments.emplace_back("--die-with-parent");
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments)
    pointers.push_back(argument.data());
  pointers.push_back(nullptr);

  const SpawnSettings settings;
  pid_t child = 0;
  if (posix_spawn(&child, options_.program.c_str(), &settings.files, &settings.attributes, pointers.data(), environ) ==
      0) {
    child_ = child;
  }
}

void SimulatedLink::reap(Timestamp now) {
  if (child_ == 0 || waitpid(child_, nullptr, WNOHANG) != child_) return;
  child_ = 0;
  start_at_ = now + restart_pause;
}

}  // namespace telehug
