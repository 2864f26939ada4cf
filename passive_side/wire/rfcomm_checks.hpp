// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "wire/rfcomm_socket.hpp"

namespace telehug {

struct RfcommCheck {
  bool passed = false;
  std::string sentence;  // what is so, or what is wrong and what to do
};

// What a jacket by Bluetooth needs, one after the other, until something is missing: sockets of the kernel, BlueZ, an
// adapter that is on, the pairing; then whether it is connected. Waits for BlueZ, 2 s at most: not for daemons at work.
// `bus_address` empty: the system bus.
[[nodiscard]] std::vector<RfcommCheck> check_rfcomm(const RfcommPeer& peer,
                                                    RfcommSockets& sockets = kernel_rfcomm_sockets(),
                                                    const std::string& bus_address = "");

}  // namespace telehug
