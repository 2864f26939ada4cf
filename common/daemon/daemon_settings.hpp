// SPDX-License-Identifier: Apache-2.0
//
// From the configuration to the settings of the parts that both daemons have.
#pragma once

#include "config/config.hpp"
#include "dds/settings.hpp"
#include "service/control_server.hpp"

namespace telehug {

[[nodiscard]] DdsSettings dds_settings(const PeerConfig& config, Side side);
[[nodiscard]] ControlServerOptions control_options(const ControlConfig& config, Side side);

}  // namespace telehug
