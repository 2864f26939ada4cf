// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "common/messages.hpp"

namespace telehug {

inline constexpr std::size_t unassigned = max_contacts;

using AssignmentCosts = std::array<std::array<double, max_contacts>, max_contacts>;  // [row][column], >= 0
using Assignment = std::array<std::size_t, max_contacts>;                            // column of each row

// The pairing of rows and columns with the least sum of costs, where leaving a row alone costs `alone`: no pair costs
// more than that. `rows`, `columns` <= max_contacts.
[[nodiscard]] Assignment assign(const AssignmentCosts& costs, std::size_t rows, std::size_t columns, double alone);

}  // namespace telehug
