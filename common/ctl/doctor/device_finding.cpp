// SPDX-License-Identifier: Apache-2.0
#include "ctl/doctor/device_finding.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace telehug {
namespace {

std::string join_group(const std::string& group, const SideFacts& side) {
  const std::string add = fmt::format("sudo usermod -aG {} {}", group, side.account.name);
  return side.account.service ? fmt::format("{}, then sudo systemctl restart {}", add, system_unit(side.side))
                              : add + ", then log in again";
}

}  // namespace

Finding device_finding(const std::string& check, const std::string& thing, const std::string& wanted,
                       const std::vector<DeviceNode>& nodes, const std::string& group, const SideFacts& side,
                       bool used) {
  const auto node =
      wanted.empty() ? nodes.begin()
                     : std::find_if(nodes.begin(), nodes.end(), [&](const DeviceNode& n) { return n.path == wanted; });
  if (node == nodes.end()) {
    return wanted.empty()
               ? Finding{check, Level::fail, fmt::format("there is no {}", thing), "plug it in; it is found by itself"}
               : Finding{check, Level::fail, fmt::format("{} is not there", wanted),
                         fmt::format("plug the {} in, or correct its name in the configuration", thing)};
  }
  if (!node->usable && !used) {
    return {check, Level::fail, fmt::format("{} may not be used by {}", node->path, side.account.name),
            join_group(group, side)};
  }
  return {check, Level::ok, fmt::format("{} can be used", node->path), {}};
}

}  // namespace telehug
