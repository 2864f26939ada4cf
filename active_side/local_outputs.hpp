// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "config/config.hpp"
#include "local_touch/local_touch_output.hpp"

namespace telehug {

// Those that the configuration turns on; none by default.
[[nodiscard]] std::vector<std::unique_ptr<LocalTouchOutput>> local_outputs(const LocalTouchConfig& config);

}  // namespace telehug
