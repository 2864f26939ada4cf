// SPDX-License-Identifier: Apache-2.0
//
// What a status tells of the jacket (common/ctl/README.md).
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "link/jacket_link.hpp"

namespace telehug {

// `running`: ids of the actuators that run.
[[nodiscard]] nlohmann::json jacket_json(const std::string& name, const LinkStatus& link,
                                         std::span<const std::uint8_t> running);

// Adds what is wrong with the jacket or on the way to it.
void add_jacket_problems(nlohmann::json& problems, const LinkStatus& link);

}  // namespace telehug
