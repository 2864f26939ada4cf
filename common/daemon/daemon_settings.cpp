// SPDX-License-Identifier: Apache-2.0
#include "daemon/daemon_settings.hpp"

#include "service/control_socket.hpp"

namespace telehug {

ControlServerOptions control_options(const ControlConfig& config, Side side) {
  ControlServerOptions options;
  options.socket = config.socket;
  if (config.socket.empty()) options.socket = default_control_socket(side);
  options.group = config.group;
  return options;
}

}  // namespace telehug
