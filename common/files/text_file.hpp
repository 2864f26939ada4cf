// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace telehug {

// A file of settings is a few kB; this keeps a wrong path (a disk, a recording) from filling the memory.
inline constexpr std::size_t most_text_bytes = 1 << 20;
// toml++ makes a table of every dot in a key and takes them apart recursively: a line of 100 kB overflows the stack.
inline constexpr std::size_t longest_line_bytes = 4096;

// The number of the first line that is longer; 0 if none is.
[[nodiscard]] std::size_t too_long_line(std::string_view text);

// The whole of a text that a person may have edited, for toml::parse(). The error completes "file: ".
Result<std::string> read_text_file(const std::filesystem::path& file);

}  // namespace telehug
