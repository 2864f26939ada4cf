// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>

#include "common/result.hpp"
#include "jacket/jacket_profile.hpp"
#include "link/jacket_link.hpp"
#include "link/simulated_link.hpp"
#include "wire/serial_port.hpp"

namespace telehug {

// What is said on the wire.
enum class LinkProtocol {
  telehug,  // protocol.hpp
  legacy,   // legacy_session.hpp
};

struct LinkOptions {
  unsigned baud = default_baud;
  LinkProtocol protocol = LinkProtocol::telehug;
  SimulatorOptions simulator;
};

// Of a jacket that has this profile. baud: in place of the profile's own, unless 0.
[[nodiscard]] LinkOptions link_options(const JacketProfile& profile, int baud = 0);

// The link that `spec` names: `serial:PATH` (a terminal device; `serial:auto`: the only one in /dev/serial/by-id),
// `rfcomm:AA:BB:CC:DD:EE:FF` or `rfcomm:AA:BB:CC:DD:EE:FF/CHANNEL` (Bluetooth), `simulated` (the firmware in a
// simulated microcontroller) or `record:FILE` (no jacket, the commands go to a CSV file).
[[nodiscard]] Result<std::unique_ptr<JacketLink>> make_link(std::string_view spec, const LinkOptions& options = {});

}  // namespace telehug
