// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "common/messages.hpp"
#include "common/result.hpp"
#include "config/load.hpp"

namespace telehug {

// Where the daemon of this side looks for its pairs: as its configuration says, as far as that can be read, else in the
// state folder. An error for whoever is neither root nor the service's account where the wearer's daemon is the
// packaged service: in their own folder it would never look. `command`: what they wanted, for the sentence. `root`:
// where the files of the system begin, "/" but for tests.
[[nodiscard]] Result<std::filesystem::path> place_of_pairs(Side side, const ConfigSources& sources,
                                                           const std::string& command, uid_t caller,
                                                           const std::filesystem::path& root = "/");

}  // namespace telehug
