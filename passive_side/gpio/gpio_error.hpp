// SPDX-License-Identifier: Apache-2.0
//
// Sentences for what the kernel says of chips and lines.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace telehug {

// error: an errno.
[[nodiscard]] Error chip_error(std::string_view chip, int error);
[[nodiscard]] Error line_error(std::string_view chip, std::string_view line, int error);

// A line's number, if it is named by one.
[[nodiscard]] std::optional<unsigned> line_number(std::string_view line);

}  // namespace telehug
