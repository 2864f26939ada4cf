// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "ctl/doctor/checks.hpp"

namespace telehug {

// One finding for a device that was named, or for the only one there should be. `wanted`: as configured; empty: any.
// `group`: who is in it may use the device. `used`: the side's daemon runs, and tells by itself if it can't.
[[nodiscard]] Finding device_finding(const std::string& check, const std::string& thing, const std::string& wanted,
                                     const std::vector<DeviceNode>& nodes, const std::string& group,
                                     const SideFacts& side, bool used);

}  // namespace telehug
