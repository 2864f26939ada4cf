// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace telehug {

// A daemon's status (README.md beside this file) for a person. Parts this program does not know are shown as they are,
// parts that are missing or of another type than expected do no harm.
[[nodiscard]] std::string status_text(const nlohmann::json& status);

}  // namespace telehug
