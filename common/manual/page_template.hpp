// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace telehug {

// A page that is written by hand (deploy/man), with @DATE@, @VERSION@ and, for all exit codes, @EXIT_STATUS@ filled in.
// Throws std::runtime_error for a word between @ that is none of these.
[[nodiscard]] std::string filled_page(std::string text, std::string_view date);

}  // namespace telehug
