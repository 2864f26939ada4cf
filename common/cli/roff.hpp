// SPDX-License-Identifier: Apache-2.0
//
// Text as man(7) pages are written: troff's own characters escaped.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "service/exit_code.hpp"

namespace telehug {

// A text that may stand in a line or begin one.
[[nodiscard]] std::string roff(std::string_view text);
// As one argument of a macro, in quotes.
[[nodiscard]] std::string roff_argument(std::string_view text);
// Lines that stay as they are.
[[nodiscard]] std::string roff_example(std::string_view text);
// A tagged paragraph whose tag is bold.
[[nodiscard]] std::string roff_item(std::string_view tag, std::string_view text);

[[nodiscard]] std::string roff_title(std::string_view name, int section, std::string_view date);
// All of them with their numbers.
[[nodiscard]] std::string roff_exit_status(const std::vector<ExitCode>& codes);

}  // namespace telehug
