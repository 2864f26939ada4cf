// SPDX-License-Identifier: Apache-2.0
#include "ctl/wearers_order.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

namespace telehug {

void add_places(CLI::App& command, MutedPlaces& places) {
  command
      .add_option("boxes", places.boxes,
                  "Boxes of the grid below the face: five a row from 1 on, left to right as the others see them")
      ->check(CLI::Range(1, 100))
      ->type_name("BOX");
  command.add_option("--actuator", places.actuators, "A motor or heater by its id, wherever the touch is")
      ->check(CLI::Range(1, 255))
      ->type_name("ID");
  add_socket_option(command, places.daemons);
}

ExitCode order_mutes(const MutedPlaces& places, const std::string& command) {
  if (places.boxes.empty() && places.actuators.empty() && !places.all) {
    fmt::print(stderr, "telehug: {} what? Name boxes, such as `telehug {} 8 13`, or --actuator ID\n", command, command);
    return ExitCode::usage;
  }
  nlohmann::json request{{"command", command}, {"boxes", places.boxes}, {"actuators", places.actuators}};
  if (places.all) request["all"] = true;
  return tell_all(places.daemons, request, command + "d");
}

}  // namespace telehug
