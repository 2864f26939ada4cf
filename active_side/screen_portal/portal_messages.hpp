// SPDX-License-Identifier: Apache-2.0
//
// What org.freedesktop.portal.ScreenCast says, read into values. Nothing that another program sends is trusted: keys
// that are missing or of another type than the interface says count as not there.
#pragma once

#include <systemd/sd-bus.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace telehug {

inline constexpr std::uint32_t portal_monitors = 1;  // of the types of sources

// The portal's properties.
struct PortalAbout {
  std::uint32_t version = 1;
  std::uint32_t source_types = 0;  // bits: portal_monitors, 2 windows, 4 virtual monitors
  std::uint32_t cursor_modes = 0;  // bits: 1 hidden, 2 drawn into the picture, 4 beside it
};

struct PortalStream {
  std::uint32_t node = 0;                    // of PipeWire
  std::optional<std::uint32_t> source_type;  // one of the bits above; since version 3
};

// The answer to a request, of any of its steps.
struct PortalResponse {
  std::uint32_t code = 0;  // 0 done, 1 the user said no, 2 ended in some other way
  std::string session;     // an object path; empty: none
  std::vector<PortalStream> streams;
  std::string restore_token;  // empty: none
};

// The reply to org.freedesktop.DBus.Properties.GetAll.
std::optional<PortalAbout> read_portal_about(sd_bus_message* message);

// The signal org.freedesktop.portal.Request.Response.
std::optional<PortalResponse> read_portal_response(sd_bus_message* message);

}  // namespace telehug
