// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "netlab/captured_packet.hpp"
#include "netlab/net_namespace.hpp"

namespace telehug {

// The raw end of a network interface: every frame that arrives there, and frames sent from there. Errors are
// std::system_error.
class EthernetPort {
 public:
  EthernetPort(const NetNamespace& network, const std::string& interface);
  ~EthernetPort();
  EthernetPort(const EthernetPort&) = delete;
  EthernetPort& operator=(const EthernetPort&) = delete;

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  // The next frame that waits; empty: none does.
  [[nodiscard]] Bytes receive() const;
  // A frame that the interface can't take is lost, as on a wire: false.
  bool send(const Bytes& frame) const;

 private:
  int descriptor_ = -1;
};

// Lets the kernel write checksums itself: a veth leaves them to a network card that is not there.
void write_checksums(const NetNamespace& network, const std::string& interface);

}  // namespace telehug
