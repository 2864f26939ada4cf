// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>

#include "ctl/command.hpp"
#include "ctl/daemons.hpp"

namespace telehug {

void add_unpause(CLI::App& app, ExitCode& result) {
  auto choice = std::make_shared<DaemonChoice>(DaemonChoice{.side = "passive", .socket = {}});
  CLI::App* command = app.add_subcommand("unpause", "End the wearer's pause");
  add_socket_option(*command, *choice);
  command->callback([choice, &result] { result = tell_all(*choice, {{"command", "unpause"}}, "unpaused"); });
}

}  // namespace telehug
