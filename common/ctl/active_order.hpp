// SPDX-License-Identifier: Apache-2.0
//
// A subcommand that says one of a few words to the active daemon.
#pragma once

#include <string>
#include <vector>

#include "service/exit_code.hpp"

namespace CLI {
class App;
}

namespace telehug {

struct ActiveOrder {
  std::string command;  // of the subcommand and of the request
  std::string about;
  std::string field;  // of the request, and the argument's name
  std::vector<std::string> words;
  std::string meanings;
};

void add_active_order(CLI::App& app, ExitCode& result, const ActiveOrder& order);

}  // namespace telehug
