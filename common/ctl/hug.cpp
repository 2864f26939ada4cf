// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "ctl/command.hpp"
#include "ctl/daemons.hpp"

namespace telehug {
namespace {

struct Options {
  DaemonChoice daemons;
  std::optional<double> seconds;
  std::optional<double> strength;
};

bool is_there(const std::string& side) {
  return !find_daemons({.side = side, .socket = {}}).found.empty();
}

ExitCode run(const Options& options) {
  const bool anybody = options.daemons.side.empty() && options.daemons.socket.empty();
  if (anybody && is_there("active") && is_there("passive")) {
    fmt::print(stderr, "telehug: both sides run on this PC: --side active hugs the wearer, --side passive hugs back\n");
    return ExitCode::usage;
  }
  nlohmann::json request = {{"command", "hug"}};
  if (options.seconds) request["seconds"] = *options.seconds;
  if (options.strength) request["strength"] = *options.strength;
  return tell_all(options.daemons, request, "hug");
}

}  // namespace

void add_hug(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "hug", "Hug the other side: the wearer feels it without a camera; the wearer's own hug is seen and heard");
  command->add_option("--seconds", options->seconds, "For how long the wearer is hugged (default: 2.5)")
      ->check(CLI::Range(0.5, 10.0));
  command->add_option("--strength", options->strength, "How strong, 0 to 1 of what the jacket may do (default: 0.7)")
      ->check(CLI::Range(0.01, 1.0));
  add_daemon_options(*command, options->daemons);
  command->callback([options, &result] { result = run(*options); });
}

}  // namespace telehug
