// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "netlab/two_homes.hpp"

namespace telehug {

// A PC behind the router of a home, which `TwoHomes::network(home)` becomes. Both homes have the same private
// addresses, as most have. The router hides the PC behind its own address and lets nothing in that the PC did not ask
// for.
class HiddenPc {
 public:
  // Throws as TwoHomes does.
  HiddenPc(const TwoHomes& homes, Home home);

  [[nodiscard]] const NetNamespace& network() const noexcept { return network_; }
  // From now on the router lets these UDP ports in to the PC.
  void forward(std::uint16_t first_port, std::uint16_t last_port) const;

 private:
  const NetNamespace& router_;
  NetNamespace network_;
};

}  // namespace telehug
