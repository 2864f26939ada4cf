// SPDX-License-Identifier: Apache-2.0
//
// Files that only their owner may read. These throw std::runtime_error with a sentence that names the file.
#pragma once

#include <filesystem>
#include <string>

namespace telehug {

// 0700; the folders above it as usual.
void make_secret_folder(const std::filesystem::path& folder);
// 0600, and either the old content or the new one, whatever happens meanwhile.
void write_secret(const std::filesystem::path& file, const std::string& content);
// Empty if there is none.
[[nodiscard]] std::string read_secret(const std::filesystem::path& file);
// Overwritten before it is removed. (A journal or a flash disk may keep old blocks: encrypt the disk.)
void wipe(const std::filesystem::path& file);

}  // namespace telehug
