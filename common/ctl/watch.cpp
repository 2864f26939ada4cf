// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <poll.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "ctl/command.hpp"
#include "ctl/daemons.hpp"
#include "ctl/plain_text.hpp"
#include "ctl/watch_text.hpp"

namespace telehug {
namespace {

struct Options {
  DaemonChoice daemons;
  bool json = false;
  int count = 0;
};

class Watch {
 public:
  explicit Watch(const Options& options) : options_(options) {}

  ExitCode run() {
    Daemons daemons = find_daemons(options_.daemons);
    result_ = complain_of_unreachable(daemons);
    for (Daemon& daemon : daemons.found) {
      const auto reply = daemon.client.ask({{"command", "watch"}});
      if (!reply) return complain(daemon, ExitCode::bad_answer, reply.error().message);
      if (reply->contains("error")) return complain(daemon, ExitCode::refused, text_of((*reply)["error"]));
    }
    while (!done_ && !daemons.found.empty()) {
      wait(daemons);
      for (auto daemon = daemons.found.begin(); daemon != daemons.found.end() && !done_;) {
        if (print_all(*daemon)) {
          ++daemon;
        } else {
          daemon = daemons.found.erase(daemon);
        }
      }
    }
    return result_;
  }

 private:
  static void wait(const Daemons& daemons) {
    std::vector<pollfd> descriptors;
    descriptors.reserve(daemons.found.size());
    for (const Daemon& daemon : daemons.found)
      descriptors.push_back({daemon.client.fd(), POLLIN, 0});
    poll(descriptors.data(), descriptors.size(), -1);
  }

  // Everything a daemon has sent; false when it is gone.
  bool print_all(Daemon& daemon) {
    while (!done_) {
      const auto event = daemon.client.next(Duration::zero());
      if (!event) {
        result_ = complain(daemon, ExitCode::not_running, event.error().message);
        return false;
      }
      if (!*event) return true;
      print(**event);
    }
    return true;
  }

  void print(const nlohmann::json& event) {
    fmt::print("{}\n", options_.json ? event.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                                     : watch_text(event));
    (void)std::fflush(stdout);
    done_ = options_.count > 0 && ++printed_ >= options_.count;
  }

  const Options& options_;
  int printed_ = 0;
  bool done_ = false;
  ExitCode result_ = ExitCode::ok;
};

}  // namespace

void add_watch(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("watch", "Show touches, answers and changes as they happen, until Ctrl-C");
  add_daemon_options(*command, options->daemons);
  command->add_flag("--json", options->json, "Print each event as a line of JSON");
  command->add_option("--count", options->count, "End after so many events (default: go on)")
      ->check(CLI::Range(1, 1'000'000'000));
  command->callback([options, &result] { result = Watch(*options).run(); });
}

}  // namespace telehug
