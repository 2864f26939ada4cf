// SPDX-License-Identifier: Apache-2.0
//
// Which daemons a subcommand talks to, and what it says when there is none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "service/control_client.hpp"
#include "service/exit_code.hpp"

namespace CLI {
class App;
}

namespace telehug {

struct DaemonChoice {
  std::string side;    // "active", "passive"; empty: both
  std::string socket;  // empty: the usual places
};

// --side and --socket.
void add_daemon_options(CLI::App& command, DaemonChoice& choice);

struct Daemon {
  std::filesystem::path socket;
  ControlClient client;
};

struct Daemons {
  std::vector<Daemon> found;
  // If none was found: why, as an exit code and a sentence.
  ExitCode failure = ExitCode::not_running;
  std::string sentence;
};

// Every daemon that can be reached, active before passive.
[[nodiscard]] Daemons find_daemons(const DaemonChoice& choice);

// What a daemon that can't be spoken to, or refuses, means to the user. Prints to stderr.
ExitCode complain(const std::filesystem::path& socket, ExitCode code, const std::string& sentence);

// Asks every daemon the same and prints "SIDE: <done>" for each that accepts. Used by stop and resume.
ExitCode tell_all(const DaemonChoice& choice, const nlohmann::json& request, const std::string& done);

}  // namespace telehug
