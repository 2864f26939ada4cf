// SPDX-License-Identifier: Apache-2.0
//
// D-Bus through libsystemd's sd-bus: what it counts references of is owned here.
#pragma once

#include <systemd/sd-bus.h>

#include <memory>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace telehug {

struct BusCloser {
  void operator()(sd_bus* bus) const { sd_bus_close_unref(bus); }
};
struct BusMessageReleaser {
  void operator()(sd_bus_message* message) const { sd_bus_message_unref(message); }
};
struct BusSlotReleaser {
  void operator()(sd_bus_slot* slot) const { sd_bus_slot_unref(slot); }
};

using Bus = std::unique_ptr<sd_bus, BusCloser>;
using BusMessage = std::unique_ptr<sd_bus_message, BusMessageReleaser>;
using BusSlot = std::unique_ptr<sd_bus_slot, BusSlotReleaser>;  // its end ends the match or the wait for a reply

// Starts to connect and does not wait for it: what is sent meanwhile waits for the bus. `address` empty: the session
// bus. `purpose`: of the error's sentence, "to ask the desktop for its screen".
Result<Bus> connect_to_bus(const std::string& address, std::string_view purpose);

// Likewise; `address` empty: the system bus.
Result<Bus> connect_to_system_bus(const std::string& address);

}  // namespace telehug
