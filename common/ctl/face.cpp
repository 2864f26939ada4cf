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
  std::string order;
};

}  // namespace

void add_face(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("face", "Choose the remote person among the faces on the screen");
  command
      ->add_option("order", options->order,
                   "next: follow the next face to the right; pin: stay with this face and its place; unpin: no longer")
      ->required()
      ->check(CLI::IsMember({"next", "pin", "unpin"}));
  add_socket_option(*command, options->daemons);
  command->callback([options, &result] {
    result = tell_all(options->daemons, {{"command", "face"}, {"order", options->order}}, "face: " + options->order);
  });
}

}  // namespace telehug
