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
  DaemonChoice daemons{.side = "passive", .socket = {}};
  std::optional<int> minutes;
};

ExitCode run(const Options& options) {
  nlohmann::json request{{"command", "pause"}};
  if (!options.minutes) return tell_all(options.daemons, request, "paused until `telehug unpause`");
  request["minutes"] = *options.minutes;
  return tell_all(options.daemons, request, fmt::format("paused for {} min", *options.minutes));
}

}  // namespace

void add_pause(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("pause", "The wearer wants nothing felt for a while; kept over restarts");
  command->add_option("minutes", options->minutes, "For how long (default: until `telehug unpause`)")
      ->check(CLI::Range(1, 24 * 60))
      ->type_name("MINUTES");
  add_socket_option(*command, options->daemons);
  command->callback([options, &result] { result = run(*options); });
}

}  // namespace telehug
