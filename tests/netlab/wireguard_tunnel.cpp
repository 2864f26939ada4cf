// SPDX-License-Identifier: Apache-2.0
#include "netlab/wireguard_tunnel.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <exception>

#include "netlab/run_inside.hpp"

namespace telehug {

bool tunnels_are_permitted() {
  const int tun = open("/dev/net/tun", O_RDWR | O_CLOEXEC);
  if (tun >= 0) close(tun);
  return tun >= 0 && geteuid() == 0;
}

WireguardTunnel::WireguardTunnel(const NetNamespace& network, const std::filesystem::path& file)
    : network_(network), interface_(file.stem().string()) {
  // Both ends have the same name, by which wireguard-go is spoken to in /run: each gets one of its own.
  run_inside(network_, {"unshare", "--mount", "sh", "-c", "mount -t tmpfs none /run && exec wg-quick up \"$0\" 2>&1",
                        file.string()});
}

WireguardTunnel::~WireguardTunnel() {
  try {
    run_inside(network_, {"ip", "link", "delete", interface_});  // wireguard-go ends with it
  } catch (const std::exception& problem) {
    (void)std::fprintf(stderr, "a tunnel was left behind: %s\n", problem.what());
  }
}

}  // namespace telehug
