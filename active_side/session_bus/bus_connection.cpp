// SPDX-License-Identifier: Apache-2.0
#include "session_bus/bus_connection.hpp"

#include <fmt/format.h>

#include <cstring>
#include <utility>

namespace telehug {

Result<Bus> connect_to_bus(const std::string& address, std::string_view purpose) {
  sd_bus* made = nullptr;
  int code = address.empty() ? sd_bus_open_user(&made) : sd_bus_new(&made);
  Bus bus(made);
  if (!address.empty()) {
    if (code >= 0) code = sd_bus_set_address(made, address.c_str());
    if (code >= 0) code = sd_bus_set_bus_client(made, 1);
    if (code >= 0) code = sd_bus_start(made);
  }
  if (code >= 0) return Result<Bus>(std::move(bus));
  return Error{fmt::format("There is no session bus {} ({}); run telehug in the user's graphical session.", purpose,
                           std::strerror(-code))};
}

}  // namespace telehug
