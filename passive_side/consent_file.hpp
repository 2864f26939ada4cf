// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/result.hpp"
#include "safety/consent.hpp"

namespace telehug {

// What the wearer wants as it is kept over restarts (Consent::quiet_hours are the configuration's). A file that is not
// there is one that holds nothing. Anything else than what keep_consent() has written is an error, which completes
// "file: ".
[[nodiscard]] Result<Consent> read_consent(const std::filesystem::path& file);
[[nodiscard]] Result<Consent> parse_consent(std::string_view text);

// Whole or not at all, for nobody but its owner. Makes the folder if need be.
[[nodiscard]] Status keep_consent(const std::filesystem::path& file, const Consent& consent);

}  // namespace telehug
