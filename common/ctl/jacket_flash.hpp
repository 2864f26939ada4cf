// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "service/exit_code.hpp"

namespace CLI {
class App;
}

namespace telehug {

// Adds `flash` to `telehug jacket`.
void add_jacket_flash(CLI::App& jacket, ExitCode& result);

}  // namespace telehug
