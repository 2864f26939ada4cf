// SPDX-License-Identifier: Apache-2.0
#include "ctl/active_order.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "ctl/daemons.hpp"

namespace telehug {
namespace {

struct Given {
  DaemonChoice daemons{.side = "active", .socket = {}};
  std::string word;
};

}  // namespace

void add_active_order(CLI::App& app, ExitCode& result, const ActiveOrder& order) {
  auto given = std::make_shared<Given>();
  CLI::App* command = app.add_subcommand(order.command, order.about);
  command->add_option(order.field, given->word, order.meanings)->required()->check(CLI::IsMember(order.words));
  add_socket_option(*command, given->daemons);
  command->callback([given, &result, name = order.command, field = order.field] {
    result = tell_all(given->daemons, {{"command", name}, {field, given->word}}, name + ": " + given->word);
  });
}

}  // namespace telehug
