// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/portal_errors.hpp"

#include <fmt/format.h>
#include <systemd/sd-bus-protocol.h>

namespace telehug {
namespace {

constexpr const char* backend = "the part of it that belongs to your desktop (xdg-desktop-portal-gnome, -kde or -wlr)";

}  // namespace

Error portal_call_failure(std::string_view name, bool first) {
  if (name == SD_BUS_ERROR_SERVICE_UNKNOWN || name == SD_BUS_ERROR_NAME_HAS_NO_OWNER ||
      name.starts_with("org.freedesktop.DBus.Error.Spawn.")) {
    return {fmt::format("There is no desktop portal that could share the screen; install xdg-desktop-portal and {}.",
                        backend)};
  }
  if (name == SD_BUS_ERROR_NO_REPLY || name == SD_BUS_ERROR_TIMEOUT) {
    return {"The desktop's portal does not answer; log in again if that stays so."};
  }
  if (first) {
    return {fmt::format("The desktop's portal can't share screens ({}); install {} and log in again.", name, backend)};
  }
  return {fmt::format(
      "The desktop's portal does not let telehug ask for the screen ({}); log in again or update the portal.", name)};
}

Error portal_without_monitors() {
  return {fmt::format("The desktop's portal can't share a monitor; install {} and log in again.", backend)};
}

std::optional<Error> fault_of_streams(const std::vector<PortalStream>& streams) {
  if (streams.empty()) {
    return Error{"The desktop shares no monitor though it was allowed to; choose one in its dialogue."};
  }
  if (streams.size() > 1) {
    return Error{"The desktop shares several monitors; choose only the one that the webcam looks at."};
  }
  if (streams[0].source_type.value_or(portal_monitors) != portal_monitors) {
    return Error{"The desktop shares a window, whose place is not known; choose a whole monitor in its dialogue."};
  }
  return std::nullopt;
}

}  // namespace telehug
