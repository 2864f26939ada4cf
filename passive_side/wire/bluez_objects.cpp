// SPDX-License-Identifier: Apache-2.0
#include "wire/bluez_objects.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace telehug {
namespace {

constexpr std::uint64_t patience_us = 2'000'000;

// Everything that is asked of an object's properties; what another type has is left as it is.
struct Properties {
  std::string address;
  bool powered = false;
  bool paired = false;
  bool connected = false;
  bool has_serial_port = false;
};

bool enter(sd_bus_message* message, char type, const char* contents) {
  return sd_bus_message_enter_container(message, type, contents) > 0;
}

bool leave(sd_bus_message* message) {
  return sd_bus_message_exit_container(message) >= 0;
}

bool is_variant_of(sd_bus_message* message, const char* contents) {
  return sd_bus_message_verify_type(message, SD_BUS_TYPE_VARIANT, contents) > 0;
}

bool read_flag(sd_bus_message* message, bool& flag) {
  int value = 0;
  if (sd_bus_message_read(message, "v", "b", &value) < 0) return false;
  flag = value != 0;
  return true;
}

bool read_uuids(sd_bus_message* message, bool& has_serial_port) {
  if (!enter(message, SD_BUS_TYPE_VARIANT, "as") || !enter(message, SD_BUS_TYPE_ARRAY, "s")) return false;
  const char* uuid = nullptr;
  while (sd_bus_message_read(message, "s", &uuid) > 0)
    has_serial_port = has_serial_port || std::string_view(uuid) == serial_port_uuid;
  if (!leave(message)) return false;
  return leave(message);
}

bool read_property(sd_bus_message* message, Properties& properties) {
  const char* name = nullptr;
  if (sd_bus_message_read(message, "s", &name) <= 0) return false;
  const std::string_view key = name;
  if (key == "Address" && is_variant_of(message, "s")) {
    const char* text = nullptr;
    if (sd_bus_message_read(message, "v", "s", &text) < 0) return false;
    properties.address = text;
    return true;
  }
  if (key == "Powered" && is_variant_of(message, "b")) return read_flag(message, properties.powered);
  if (key == "Paired" && is_variant_of(message, "b")) return read_flag(message, properties.paired);
  if (key == "Connected" && is_variant_of(message, "b")) return read_flag(message, properties.connected);
  if (key == "UUIDs" && is_variant_of(message, "as")) return read_uuids(message, properties.has_serial_port);
  return sd_bus_message_skip(message, "v") >= 0;
}

bool read_properties(sd_bus_message* message, Properties& properties) {
  if (!enter(message, SD_BUS_TYPE_ARRAY, "{sv}")) return false;
  while (enter(message, SD_BUS_TYPE_DICT_ENTRY, "sv"))
    if (!read_property(message, properties) || !leave(message)) return false;
  return leave(message);
}

bool read_object(sd_bus_message* message, BluezObjects& objects) {
  const char* path = nullptr;
  if (sd_bus_message_read(message, "o", &path) <= 0 || !enter(message, SD_BUS_TYPE_ARRAY, "{sa{sv}}")) return false;
  while (enter(message, SD_BUS_TYPE_DICT_ENTRY, "sa{sv}")) {
    const char* interface = nullptr;
    Properties found;
    if (sd_bus_message_read(message, "s", &interface) <= 0 || !read_properties(message, found)) return false;
    if (interface == std::string_view("org.bluez.Adapter1")) {
      ++objects.adapters;
      objects.adapters_on += found.powered ? 1 : 0;
    } else if (interface == std::string_view("org.bluez.Device1")) {
      objects.devices.push_back({path, found.address, found.paired, found.connected, found.has_serial_port});
    }
    if (!leave(message)) return false;
  }
  return leave(message);
}

}  // namespace

const BluezDevice* BluezObjects::find(const RfcommPeer& peer) const {
  const auto found = std::ranges::find(devices, address_text(peer), &BluezDevice::address);
  return found == devices.end() ? nullptr : &*found;
}

BusMessage bluez_objects_call(sd_bus* bus) {
  sd_bus_message* call = nullptr;
  sd_bus_message_new_method_call(bus, &call, bluez_service, "/", "org.freedesktop.DBus.ObjectManager",
                                 "GetManagedObjects");
  return BusMessage(call);
}

std::optional<BluezObjects> read_bluez_objects(sd_bus_message* answer) {
  if (sd_bus_message_is_method_error(answer, nullptr) != 0) return std::nullopt;
  BluezObjects objects;
  if (!enter(answer, SD_BUS_TYPE_ARRAY, "{oa{sa{sv}}}")) return std::nullopt;
  while (enter(answer, SD_BUS_TYPE_DICT_ENTRY, "oa{sa{sv}}"))
    if (!read_object(answer, objects) || !leave(answer)) return std::nullopt;
  return objects;
}

Result<BluezObjects> ask_bluez(const std::string& bus_address) {
  auto bus = connect_to_system_bus(bus_address);
  if (!bus) return bus.error();
  const BusMessage call = bluez_objects_call(bus->get());
  sd_bus_message* made = nullptr;
  sd_bus_error failure = SD_BUS_ERROR_NULL;
  const int code = sd_bus_call(bus->get(), call.get(), patience_us, &failure, &made);
  const BusMessage answer(made);
  sd_bus_error_free(&failure);
  if (code >= 0) {
    if (auto objects = read_bluez_objects(answer.get())) return *std::move(objects);
  }
  return Error{"BlueZ does not answer; install it (package bluez) and start it: `systemctl start bluetooth`"};
}

bool means_no_bluez(const sd_bus_error& error) {
  constexpr std::array<std::string_view, 3> names{SD_BUS_ERROR_SERVICE_UNKNOWN, SD_BUS_ERROR_NAME_HAS_NO_OWNER,
                                                  "org.freedesktop.DBus.Error.Spawn.ServiceNotFound"};
  return error.name != nullptr && std::ranges::find(names, error.name) != names.end();
}

std::string bluez_trouble(const BluezObjects& objects, const RfcommPeer& peer) {
  const std::string address = address_text(peer);
  if (objects.adapters == 0) return "this PC has no Bluetooth adapter; plug one in";
  if (objects.adapters_on == 0) return "Bluetooth is switched off; run `bluetoothctl power on`";
  const BluezDevice* device = objects.find(peer);
  if (device == nullptr || !device->paired) {
    return fmt::format(
        "the jacket {0} is not paired; switch it on, run `bluetoothctl`, in it `scan on`, `pair {0}` (an "
        "HC-05's PIN is 1234) and `trust {0}`",
        address);
  }
  return "";
}

}  // namespace telehug
