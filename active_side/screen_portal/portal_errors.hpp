// SPDX-License-Identifier: Apache-2.0
//
// What a user can do when the desktop's portal can't do what it is asked for.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "screen_portal/portal_messages.hpp"

namespace telehug {

// `name`: of the D-Bus error. `first`: it came for the first question, whether the portal can share screens at all.
Error portal_call_failure(std::string_view name, bool first);

Error portal_without_monitors();

// Why what the user shares can't be used; none if it is one monitor.
std::optional<Error> fault_of_streams(const std::vector<PortalStream>& streams);

}  // namespace telehug
