// SPDX-License-Identifier: Apache-2.0
#include "daemon/daemon_settings.hpp"

#include "config/locator.hpp"
#include "service/control_socket.hpp"

namespace telehug {

DdsSettings dds_settings(const PeerConfig& config, Side side) {
  DdsSettings settings;
  settings.side = side;
  settings.domain_id = static_cast<std::uint32_t>(config.domain);
  if (!config.partition.empty()) settings.partition = config.partition;
  settings.loopback_only = config.loopback_only;
  if (auto addresses = parse_addresses(config.addresses)) settings.peers = *std::move(addresses);
  return settings;
}

ControlServerOptions control_options(const ControlConfig& config, Side side) {
  ControlServerOptions options;
  options.socket = config.socket;
  if (config.socket.empty()) options.socket = default_control_socket(side);
  options.group = config.group;
  return options;
}

}  // namespace telehug
