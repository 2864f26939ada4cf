// SPDX-License-Identifier: Apache-2.0
//
// From the configuration to the settings of the parts that both daemons have.
#pragma once

#include "common/messages.hpp"
#include "config/config.hpp"
#include "service/control_server.hpp"

namespace telehug {

[[nodiscard]] ControlServerOptions control_options(const ControlConfig& config, Side side);

}  // namespace telehug
