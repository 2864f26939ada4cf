// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/result.hpp"

namespace telehug {

// Shows a page in the desktop's browser (xdg-open), which may go on for as long as it likes. The error completes a
// sentence; none if within two seconds nothing has gone wrong.
[[nodiscard]] Status show_in_browser(const std::string& url);

}  // namespace telehug
