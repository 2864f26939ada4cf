// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>

#include "common/result.hpp"
#include "link/jacket_link.hpp"
#include "link/serial_link.hpp"
#include "link/simulated_link.hpp"

namespace telehug {

struct LinkOptions {
  unsigned baud = default_baud;
  SimulatorOptions simulator;
};

// The link that `spec` names: `serial:PATH` (a terminal device), `simulated` (the firmware in a simulated
// microcontroller) or `record:FILE` (no jacket, the commands go to a CSV file).
[[nodiscard]] Result<std::unique_ptr<JacketLink>> make_link(std::string_view spec, const LinkOptions& options = {});

}  // namespace telehug
