// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "ctl/command.hpp"
#include "ctl/daemons.hpp"
#include "ctl/plain_text.hpp"

namespace telehug {
namespace {

ExitCode run(const DaemonChoice& choice) {
  Daemons daemons = find_daemons(choice);
  if (const ExitCode code = complain_of_unreachable(daemons); daemons.found.empty()) return code;
  // Both texts in a row would be none.
  if (daemons.found.size() > 1) {
    fmt::print(stderr, "telehug: both sides run on this PC: choose one with --side\n");
    return ExitCode::usage;
  }
  Daemon& daemon = daemons.found.front();
  const auto reply = daemon.client.ask({{"command", "metrics"}});
  if (!reply) return complain(daemon, ExitCode::bad_answer, reply.error().message);
  if (reply->contains("error")) return complain(daemon, ExitCode::refused, text_of((*reply)["error"]));
  const auto text = reply->find("openmetrics");
  if (text == reply->end() || !text->is_string())
    return complain(daemon, ExitCode::bad_answer, "there are no metrics in the answer");
  fmt::print("{}", text->get_ref<const std::string&>());
  return ExitCode::ok;
}

}  // namespace

void add_metrics(CLI::App& app, ExitCode& result) {
  auto choice = std::make_shared<DaemonChoice>();
  CLI::App* command = app.add_subcommand("metrics", "Print a daemon's counters and latencies as OpenMetrics text");
  add_daemon_options(*command, *choice);
  command->callback([choice, &result] { result = run(*choice); });
}

}  // namespace telehug
