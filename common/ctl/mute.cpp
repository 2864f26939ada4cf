// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "ctl/command.hpp"
#include "ctl/wearers_order.hpp"

namespace telehug {

void add_mute(CLI::App& app, ExitCode& result) {
  auto places = std::make_shared<MutedPlaces>();
  CLI::App* command =
      app.add_subcommand("mute", "The wearer wants no touch felt in these boxes, or by these motors and heaters");
  command->footer(
      "\nA motor or heater that lies in a muted box, on the front or behind it, does not take part in touches beside "
      "the "
      "box either.");
  add_places(*command, *places);
  command->callback([places, &result] { result = order_mutes(*places, "mute"); });
}

}  // namespace telehug
