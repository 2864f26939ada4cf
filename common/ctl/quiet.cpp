// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "config/quiet_hours_text.hpp"
#include "ctl/command.hpp"
#include "ctl/daemons.hpp"

namespace telehug {
namespace {

struct Options {
  DaemonChoice daemons{.side = "passive", .socket = {}};
  std::string hours;
};

std::string fault_in(const std::string& hours) {
  if (hours == "none") return {};
  if (hours.empty()) return "no quiet hours at all are \"none\"";
  const auto parsed = parse_quiet_hours(hours);
  return parsed ? "" : parsed.error().message;
}

}  // namespace

void add_quiet(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("quiet", "The wearer's own hours in which nothing is felt, beside those of the configuration");
  command->add_option("hours", options->hours, "Local times, as 20:30-07:00,13:00-14:00; none: none")
      ->required()
      ->check(CLI::Validator(fault_in, "HOURS"))
      ->type_name("");
  add_socket_option(*command, options->daemons);
  command->callback([options, &result] {
    const std::string hours = options->hours == "none" ? "" : options->hours;
    result = tell_all(options->daemons, {{"command", "quiet"}, {"hours", hours}},
                      hours.empty() ? "no quiet hours of the wearer's own" : "quiet hours: " + hours);
  });
}

}  // namespace telehug
