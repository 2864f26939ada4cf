// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "ctl/command.hpp"
#include "ctl/daemons.hpp"

namespace telehug {
namespace {

struct Options {
  DaemonChoice daemons{.side = "passive", .socket = {}};
  int percent = 100;
};

}  // namespace

void add_strength(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("strength", "The wearer wants all touches weaker than the limits allow; kept over restarts");
  command->add_option("percent", options->percent, "Of what the limits allow")
      ->required()
      ->check(CLI::Range(1, 100))
      ->type_name("PERCENT");
  add_socket_option(*command, options->daemons);
  command->callback([options, &result] {
    result = tell_all(options->daemons, {{"command", "strength"}, {"strength", options->percent / 100.0}},
                      fmt::format("{} % of what the limits allow", options->percent));
  });
}

}  // namespace telehug
