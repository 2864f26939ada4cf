// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "ctl/command.hpp"
#include "ctl/daemons.hpp"
#include "ctl/plain_text.hpp"
#include "ctl/status_text.hpp"

namespace telehug {
namespace {

struct Options {
  DaemonChoice daemons;
  bool json = false;
  bool check = false;
};

// What --check makes of a status: the greater, the graver. A fault is graver than a stop, a stop than an absent peer.
ExitCode verdict(const nlohmann::json& status) {
  const std::string state = status.contains("state") ? text_of(status["state"]) : "";
  if (state == "fault") return ExitCode::fault;
  if (state == "stopped" || state == "paused") return ExitCode::stopped;
  const auto connected = status.value("/peer/connected"_json_pointer, nlohmann::json(true));
  return connected == false ? ExitCode::peer_absent : ExitCode::ok;
}

ExitCode run(const Options& options) {
  Daemons daemons = find_daemons(options.daemons);
  ExitCode result = complain_of_unreachable(daemons);
  ExitCode gravest = ExitCode::ok;
  auto all = nlohmann::json::array();
  for (Daemon& daemon : daemons.found) {
    const auto reply = daemon.client.ask({{"command", "status"}});
    if (!reply) {
      result = complain(daemon, ExitCode::bad_answer, reply.error().message);
      continue;
    }
    if (reply->contains("error")) {
      result = complain(daemon, ExitCode::refused, text_of((*reply)["error"]));
      continue;
    }
    if (options.check) gravest = std::max(gravest, verdict(*reply));
    all.push_back(*reply);
  }
  if (options.json) {
    fmt::print("{}\n", nlohmann::json{{"daemons", all}}.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    for (std::size_t i = 0; i < all.size(); ++i)
      fmt::print("{}{}", i == 0 ? "" : "\n", status_text(all[i]));
  }
  return result == ExitCode::ok ? gravest : result;
}

}  // namespace

void add_status(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("status", "Show how the daemons on this PC are and what they do");
  add_daemon_options(*command, options->daemons);
  command->add_flag("--json", options->json, "Print {\"daemons\": [status, ...]} for programs");
  command->add_flag("--check", options->check,
                    "End with 12 if a side reports a fault, 11 if stopped or paused, 6 if its peer is absent");
  command->callback([options, &result] { result = run(*options); });
}

}  // namespace telehug
