// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/result.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

// The profile with what the wearer's own file changes: limits that are lower than the profile's, actuators that are
// switched off. A file can't allow more than the profile does. Errors as of load_jacket_profile(), and if no actuator
// is left.
Result<JacketProfile> with_overrides(JacketProfile profile, const std::filesystem::path& file);

}  // namespace telehug
