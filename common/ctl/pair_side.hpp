// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/messages.hpp"
#include "common/result.hpp"

namespace telehug {

// Which side this PC is: as given ("active", "passive"), else the one whose daemon is installed beside this program or,
// where both are, the one that runs.
[[nodiscard]] Result<Side> side_of_this_pc(const std::string& given);

}  // namespace telehug
