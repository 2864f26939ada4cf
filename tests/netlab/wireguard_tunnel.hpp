// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "netlab/net_namespace.hpp"

namespace telehug {

// Can programs here make tunnels? Needs root and /dev/net/tun.
[[nodiscard]] bool tunnels_are_permitted();

// One end of a WireGuard tunnel, begun from its file by wg-quick as on a person's PC. The tunnel itself is
// wireguard-go, where the kernel has no WireGuard of its own.
class WireguardTunnel {
 public:
  // `file`: its name without ".conf" becomes the interface's. Throws std::runtime_error if wg-quick fails.
  WireguardTunnel(const NetNamespace& network, const std::filesystem::path& file);
  ~WireguardTunnel();
  WireguardTunnel(const WireguardTunnel&) = delete;
  WireguardTunnel& operator=(const WireguardTunnel&) = delete;

 private:
  const NetNamespace& network_;
  std::string interface_;
};

}  // namespace telehug
