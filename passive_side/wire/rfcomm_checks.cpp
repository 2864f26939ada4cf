// SPDX-License-Identifier: Apache-2.0
#include "wire/rfcomm_checks.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include "wire/bluez_objects.hpp"

namespace telehug {

std::vector<RfcommCheck> check_rfcomm(const RfcommPeer& peer, RfcommSockets& sockets, const std::string& bus_address) {
  std::vector<RfcommCheck> checks;
  const int socket = sockets.open();
  if (socket < 0) {
    checks.push_back({false, rfcomm_trouble(peer, peer.channel.value_or(1), -socket)});
    return checks;
  }
  close(socket);
  checks.push_back({true, "the kernel has Bluetooth"});

  const auto objects = ask_bluez(bus_address);
  if (!objects) {
    checks.push_back({false, objects.error().message});
    return checks;
  }
  if (const std::string trouble = bluez_trouble(*objects, peer); !trouble.empty()) {
    checks.push_back({false, trouble});
    return checks;
  }
  checks.push_back({true, fmt::format("a Bluetooth adapter is on, and the jacket {} is paired", address_text(peer))});
  const BluezDevice& device = *objects->find(peer);
  if (!device.has_serial_port && !peer.channel) {
    checks.push_back({false, "the jacket has told BlueZ of no serial port; check the address, or connect to it once"});
  }
  checks.push_back({true, device.connected ? "it is connected" : "it is not connected now"});
  return checks;
}

}  // namespace telehug
