// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>

#include "ctl/command.hpp"
#include "ctl/daemons.hpp"

namespace telehug {

void add_resume(CLI::App& app, ExitCode& result) {
  auto choice = std::make_shared<DaemonChoice>();
  CLI::App* command = app.add_subcommand("resume", "End this PC's own stop");
  add_daemon_options(*command, *choice);
  command->callback([choice, &result] { result = tell_all(*choice, {{"command", "resume"}}, "resumed"); });
}

}  // namespace telehug
