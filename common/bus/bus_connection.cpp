// SPDX-License-Identifier: Apache-2.0
#include "bus/bus_connection.hpp"

#include <fmt/format.h>

#include <cstring>
#include <utility>

namespace telehug {
namespace {

// To the bus at `address`, or the usual one: 0 or more, or a negative errno.
int connect(const std::string& address, int (*open_usual)(sd_bus**), Bus& bus) {
  sd_bus* made = nullptr;
  int code = address.empty() ? open_usual(&made) : sd_bus_new(&made);
  bus.reset(made);
  if (address.empty()) return code;
  if (code >= 0) code = sd_bus_set_address(made, address.c_str());
  if (code >= 0) code = sd_bus_set_bus_client(made, 1);
  if (code >= 0) code = sd_bus_start(made);
  return code;
}

}  // namespace

Result<Bus> connect_to_bus(const std::string& address, std::string_view purpose) {
  Bus bus;
  const int code = connect(address, sd_bus_open_user, bus);
  if (code >= 0) return Result<Bus>(std::move(bus));
  return Error{fmt::format("There is no session bus {} ({}); run telehug in the user's graphical session.", purpose,
                           std::strerror(-code))};
}

Result<Bus> connect_to_system_bus(const std::string& address) {
  Bus bus;
  const int code = connect(address, sd_bus_open_system, bus);
  if (code >= 0) return Result<Bus>(std::move(bus));
  return Error{fmt::format("there is no system bus ({}); install and start dbus", std::strerror(-code))};
}

}  // namespace telehug
