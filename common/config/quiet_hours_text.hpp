// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "common/quiet_hours.hpp"
#include "common/result.hpp"

namespace telehug {

// "20:30-07:00", several with commas between them; empty: none. "22:00-24:00" ends at midnight.
[[nodiscard]] Result<QuietHours> parse_quiet_hours(std::string_view text);

[[nodiscard]] std::string quiet_hours_text(const QuietHours& hours);

// "07:00".
[[nodiscard]] std::string time_of_day_text(int minute);

}  // namespace telehug
