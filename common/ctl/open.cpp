// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "ctl/browser.hpp"
#include "ctl/command.hpp"
#include "ctl/daemons.hpp"
#include "ctl/plain_text.hpp"
#include "ctl/run_program.hpp"

namespace telehug {
namespace {

constexpr Duration longest_start = 30s;

struct Options {
  DaemonChoice daemons;
  bool print = false;
  bool start = false;
};

// Whatever answers on the socket decides what is opened: no more than a page of this PC.
bool is_own_page(const std::string& url) {
  return url.starts_with("http://127.0.0.1:") &&
         std::ranges::all_of(url, [](char c) { return c > 0x20 && c < 0x7F && c != '"' && c != '\''; });
}

ExitCode show(const Daemon& daemon, const std::string& url) {
  const Status shown = show_in_browser(url);
  if (shown) return ExitCode::ok;
  return complain(daemon, ExitCode::internal,
                  fmt::format("{}; open this link within a minute: {}", shown.error().message, url));
}

// As the service of this person, whose it is to see the screen.
Status start_active_daemon() {
  const auto run = run_program({"systemctl", "--user", "start", "telehug-active.service"}, longest_start,
                               "there is no systemctl that would start telehug-active");
  if (!run) return run.error();
  if (run->code == 0) return Done{};
  return Error{fmt::format("telehug-active can't be started: {}; `journalctl --user -u telehug-active` may tell more",
                           run->timed_out ? "it takes too long" : plain_text(run->output))};
}

ExitCode open(const Options& options) {
  Daemons daemons = find_daemons(options.daemons);
  const bool none_runs = daemons.found.empty() && daemons.unreachable.front().code == ExitCode::not_running;
  if (options.start && none_runs) {
    if (const Status started = start_active_daemon(); !started) {
      fmt::print(stderr, "telehug: {}\n", started.error().message);
      return ExitCode::not_running;
    }
    daemons = find_daemons(options.daemons);
  }
  ExitCode result = complain_of_unreachable(daemons);
  for (Daemon& daemon : daemons.found) {
    const auto reply = daemon.client.ask({{"command", "open"}});
    if (!reply) {
      result = complain(daemon, ExitCode::bad_answer, reply.error().message);
    } else if (reply->contains("error")) {
      result = complain(daemon, ExitCode::refused, text_of((*reply)["error"]));
    } else if (const std::string url = reply->contains("url") ? text_of((*reply)["url"]) : ""; !is_own_page(url)) {
      result = complain(daemon, ExitCode::bad_answer, "the daemon tells no link: is it of another version?");
    } else if (options.print) {
      fmt::print("{}\n", url);
    } else if (const ExitCode shown = show(daemon, url); shown != ExitCode::ok) {
      result = shown;
    }
  }
  return result;
}

}  // namespace

void add_open(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("open", "Show the pages of the daemons on this PC in the browser");
  command->add_option("side", options->daemons.side, "Only this side's: active or passive (default: all on this PC)")
      ->check(CLI::IsMember({"active", "passive"}));
  command->add_flag("--start", options->start, "If there is none, first start telehug-active in this person's session");
  command->add_flag("--print", options->print, "Only print the link, which works once, within a minute");
  add_socket_option(*command, options->daemons);
  command->callback([options, &result] { result = open(*options); });
}

}  // namespace telehug
