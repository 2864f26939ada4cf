// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "ctl/command.hpp"
#include "ctl/daemons.hpp"

namespace telehug {
namespace {

struct Options {
  DaemonChoice daemons{.side = "active", .socket = {}};
  std::string mode;
};

}  // namespace

void add_send(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("send", "Do touches on the screen go out to the other side?");
  command
      ->add_option("mode", options->mode,
                   "on; off; auto: only while the pinned window is in front; toggle: off and auto in turns")
      ->required()
      ->check(CLI::IsMember({"on", "off", "auto", "toggle"}));
  add_socket_option(*command, options->daemons);
  command->callback([options, &result] {
    result = tell_all(options->daemons, {{"command", "send"}, {"mode", options->mode}}, "sending: " + options->mode);
  });
}

}  // namespace telehug
