// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "service/exit_code.hpp"

namespace CLI {
class App;
}

namespace telehug {

// Adds `check` to `telehug-active camera`.
void add_camera_check(CLI::App& camera, ExitCode& result);

}  // namespace telehug
