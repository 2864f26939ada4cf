// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "ctl/command.hpp"
#include "ctl/wearers_order.hpp"

namespace telehug {

void add_unmute(CLI::App& app, ExitCode& result) {
  auto places = std::make_shared<MutedPlaces>();
  CLI::App* command = app.add_subcommand("unmute", "What was muted may be felt again");
  add_places(*command, *places);
  command->add_flag("--all", places->all, "Everything that was muted");
  command->callback([places, &result] { result = order_mutes(*places, "unmute"); });
}

}  // namespace telehug
