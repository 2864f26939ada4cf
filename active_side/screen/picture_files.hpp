// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "common/result.hpp"

namespace telehug {

// `path` itself if it is a file; if it is a folder, the .jpg, .jpeg and .png files in it, in order of their names.
// Fails if there is none.
Result<std::vector<std::filesystem::path>> list_pictures(const std::filesystem::path& path);

}  // namespace telehug
