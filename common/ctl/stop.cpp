// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>

#include "ctl/command.hpp"
#include "ctl/daemons.hpp"

namespace telehug {
namespace {

struct Options {
  DaemonChoice daemons;
  std::string reason = "stopped with the telehug command";
};

}  // namespace

void add_stop(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("stop", "Turn everything off now, and keep it off until `telehug resume`");
  add_daemon_options(*command, options->daemons);
  command->add_option("--reason", options->reason, "Shown on both sides")->capture_default_str();
  command->callback([options, &result] {
    result = tell_all(options->daemons, {{"command", "stop"}, {"reason", options->reason}}, "stopped");
  });
}

}  // namespace telehug
