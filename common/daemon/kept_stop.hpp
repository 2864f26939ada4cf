// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace telehug {

// The reason of a stop that is kept over restarts; nothing is stopped if there is no file. Anything else than what
// keep_stop() has written is an error, which completes "file: ": then nobody knows whether everything was stopped.
[[nodiscard]] Result<std::optional<std::string>> read_kept_stop(const std::filesystem::path& file);
[[nodiscard]] Result<std::string> parse_kept_stop(std::string_view text);

// Whole or not at all, for nobody but its owner; makes the folder if need be. Without a reason the file is removed.
[[nodiscard]] Status keep_stop(const std::filesystem::path& file, const std::optional<std::string>& reason);

}  // namespace telehug
