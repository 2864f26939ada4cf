// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "netlab/net_namespace.hpp"

namespace telehug {

// Runs a program in that network to its end. Throws std::runtime_error if it fails.
void run_inside(const NetNamespace& network, const std::vector<std::string>& command);
// How other programs call that network.
[[nodiscard]] std::string path_of(const NetNamespace& network);

}  // namespace telehug
