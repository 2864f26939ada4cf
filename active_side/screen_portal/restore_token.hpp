// SPDX-License-Identifier: Apache-2.0
//
// The desktop's word that the user has consented to share the screen: shown at the next start, it spares the user the
// dialogue. Who holds it may see the screen, so it is for its owner's eyes only and is never logged.
#pragma once

#include <filesystem>
#include <string>

#include "common/result.hpp"

namespace telehug {

// Empty if there is none, or what is there is none.
[[nodiscard]] std::string read_restore_token(const std::filesystem::path& file);

// Replaces the file by one that only its owner can read (0600), in one step; makes its folder. A token that can't be
// one is not written: then the file is removed.
Status write_restore_token(const std::filesystem::path& file, const std::string& token);

void remove_restore_token(const std::filesystem::path& file);

}  // namespace telehug
