// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/result.hpp"
#include "pairing_link/pairing_code.hpp"

namespace telehug {

// This PC's IPv4 address as the other PC is to dial it: as given, else the one of the interface with the default route.
[[nodiscard]] Result<Endpoint> own_endpoint(const std::string& address, std::uint16_t port);

}  // namespace telehug
