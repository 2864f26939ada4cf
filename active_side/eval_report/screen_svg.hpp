// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "eval_report/report.hpp"

namespace telehug {

// The screen with each true point (circle), each found one (dot), a line between them, and crosses where touches were
// missed. Touches of several screens are drawn by their shares of width and height; of very many only every n-th, which
// the title then says.
[[nodiscard]] std::string screen_svg(const std::vector<ReportedTouch>& touches, bool one_screen);

}  // namespace telehug
