// SPDX-License-Identifier: Apache-2.0
//
// What lies on the disk: configuration, the folder of what telehug keeps, room.
#include <fmt/core.h>

#include "ctl/doctor/checks.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace {

// Whose folder it should be.
std::string mend_owner(const SideFacts& side) {
  return fmt::format("sudo chown -R {}: {}", side.account.name, side.state.path);
}

}  // namespace

Findings check_config(const DoctorFacts& facts) {
  Findings findings;
  for (const SideFacts& side : facts.sides) {
    if (side.config_faults.empty())
      findings.push_back({"config", Level::ok, side_name(side.side) + ": no fault in the configuration", {}});
    for (const Fault& fault : side.config_faults)
      findings.push_back({"config", Level::fail, fmt::format("{}: {}", fault.where, fault.what),
                          "correct that line; `telehug config check` tells whether it is right"});
  }
  return findings;
}

Findings check_state_folder(const DoctorFacts& facts) {
  Findings findings;
  for (const SideFacts& side : facts.sides) {
    const FolderFacts& folder = side.state;
    if (!folder.usable && !folder.there && side.account.self)
      findings.push_back({"state folder", Level::fail,
                          fmt::format("{} can't be made by {}: the folder above is {}'s", folder.path,
                                      side.account.name, folder.owner),
                          fmt::format("sudo install -d -m 700 -o {} {}", side.account.name, folder.path)});
    else if (!folder.usable)
      findings.push_back(
          {"state folder", Level::fail,
           fmt::format("{} is {}'s and can't be written by {}", folder.path, folder.owner, side.account.name),
           mend_owner(side)});
    else if (folder.open_to_all)
      findings.push_back({"state folder", Level::fail, folder.path + " holds private keys, and others may look into it",
                          "chmod 700 " + folder.path});
    else
      findings.push_back({"state folder", Level::ok, folder.path, {}});
  }
  return findings;
}

Findings check_disk(const DoctorFacts& facts) {
  constexpr std::uint64_t little = 20 << 20;
  for (const SideFacts& side : facts.sides)
    if (side.state.free_bytes < little)
      return {{"disk", Level::fail,
               fmt::format("only {} MiB are free at {}", side.state.free_bytes >> 20, side.state.path),
               "make room: what the wearer wants and new pairs can't be kept otherwise"}};
  return {{"disk", Level::ok, "has room", {}}};
}

}  // namespace telehug
