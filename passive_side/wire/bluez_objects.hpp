// SPDX-License-Identifier: Apache-2.0
//
// What BlueZ, the system's Bluetooth service, tells of adapters and devices (org.bluez on the system bus).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bus/bus_connection.hpp"
#include "common/rfcomm_peer.hpp"

namespace telehug {

inline constexpr const char* bluez_service = "org.bluez";
inline constexpr const char* serial_port_uuid = "00001101-0000-1000-8000-00805f9b34fb";  // Bluetooth Assigned Numbers

struct BluezDevice {
  std::string path;
  std::string address;  // "AA:BB:CC:DD:EE:FF"
  bool paired = false;
  bool connected = false;
  bool has_serial_port = false;  // as far as BlueZ has asked it yet
};

struct BluezObjects {
  int adapters = 0;
  int adapters_on = 0;
  std::vector<BluezDevice> devices;

  [[nodiscard]] const BluezDevice* find(const RfcommPeer& peer) const;
};

// The call that asks for them, and its answer; empty if it is an error or something else.
[[nodiscard]] BusMessage bluez_objects_call(sd_bus* bus);
[[nodiscard]] std::optional<BluezObjects> read_bluez_objects(sd_bus_message* answer);

// Waits for BlueZ, 2 s at most. `bus_address` empty: the system bus. The error says what to do after a semicolon.
[[nodiscard]] Result<BluezObjects> ask_bluez(const std::string& bus_address = "");

// Whether the error of a call to BlueZ means that there is no BlueZ.
[[nodiscard]] bool means_no_bluez(const sd_bus_error& error);

// What keeps the device from being connected, a sentence with what to do; empty if nothing does.
[[nodiscard]] std::string bluez_trouble(const BluezObjects& objects, const RfcommPeer& peer);

}  // namespace telehug
