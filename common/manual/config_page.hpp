// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "common/messages.hpp"

namespace telehug {

// Section 5 of the manual for a side's configuration: every key of the table that the file is read with.
[[nodiscard]] std::string config_page(Side side, std::string_view date);

}  // namespace telehug
