// SPDX-License-Identifier: Apache-2.0
//
// Subcommands in which the wearer says what they want: they go to the passive daemon alone.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ctl/daemons.hpp"

namespace telehug {

// The places that `telehug mute` and `telehug unmute` name.
struct MutedPlaces {
  DaemonChoice daemons{.side = "passive", .socket = {}};
  std::vector<std::uint16_t> boxes;
  std::vector<std::uint16_t> actuators;
  bool all = false;  // of unmute only
};

// BOX... and --actuator ID..., and --socket.
void add_places(CLI::App& command, MutedPlaces& places);

// Tells the daemon; complains if no place is named.
ExitCode order_mutes(const MutedPlaces& places, const std::string& command);

}  // namespace telehug
