// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/result.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

// Reads a jacket profile (TOML; the format is explained in deploy/jackets/README.md, and as a JSON schema in
// jacket.schema.json). The error lists all faults of the file at once, one "FILE:LINE: sentence" a line.
Result<JacketProfile> load_jacket_profile(const std::filesystem::path& path);

}  // namespace telehug
