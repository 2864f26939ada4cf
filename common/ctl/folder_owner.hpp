// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/result.hpp"

namespace telehug {

// For `sudo telehug pair`: root becomes, for good, whoever the folder (or the first one above it that exists) belongs
// to. What root wrote there the daemon's account could not read. Others stay who they are.
Status become_owner_of(const std::filesystem::path& folder);

}  // namespace telehug
