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

// --socket alone, where only one side is meant.
void add_socket_option(CLI::App& command, DaemonChoice& choice);

struct Daemon {
  std::filesystem::path socket;
  ControlClient client;
};

// A daemon that is there (or nearly) and can't be spoken to.
struct Unreachable {
  ExitCode code = ExitCode::bad_answer;
  std::string sentence;
  std::filesystem::path socket;  // empty: there is none
};

struct Daemons {
  std::vector<Daemon> found;
  std::vector<Unreachable> unreachable;
};

// Every daemon in the usual places (or in the given one), active before passive. If there is none at all, `unreachable`
// says so: one of the two is never empty.
[[nodiscard]] Daemons find_daemons(const DaemonChoice& choice);

// Tells of every daemon that can't be spoken to; ok if there is none such.
ExitCode complain_of_unreachable(const Daemons& daemons);

// What a daemon that can't be spoken to, or refuses, means to the user. Prints to stderr.
ExitCode complain(const Daemon& daemon, ExitCode code, const std::string& sentence);

// Asks every daemon the same and prints "SIDE: <done>" for each that accepts. Used by stop, resume and the active
// side's orders.
ExitCode tell_all(const DaemonChoice& choice, const nlohmann::json& request, const std::string& done);

}  // namespace telehug
