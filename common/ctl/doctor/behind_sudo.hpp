// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace telehug {

// The name of who asks by way of sudo(8): root has neither their configuration nor their calibration and pairs. Nothing
// if root asks by itself, or somebody else.
[[nodiscard]] std::optional<std::string> asker_behind_sudo();

// Gives root up for good and goes on as this user, with their home and their daemons' sockets. Throws std::system_error
// if the system refuses.
void become(const std::string& user);

}  // namespace telehug
