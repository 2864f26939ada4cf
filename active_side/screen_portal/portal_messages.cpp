// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/portal_messages.hpp"

#include <string_view>
#include <utility>

namespace telehug {
namespace {

// Enters the variant before which `message` stands if it holds a `type`; passes over it otherwise.
bool enter_variant(sd_bus_message* message, const char* type) {
  char container = 0;
  const char* content = nullptr;
  if (sd_bus_message_peek_type(message, &container, &content) > 0 && container == SD_BUS_TYPE_VARIANT &&
      std::string_view(content) == type) {
    return sd_bus_message_enter_container(message, SD_BUS_TYPE_VARIANT, type) > 0;
  }
  sd_bus_message_skip(message, "v");
  return false;
}

std::optional<std::uint32_t> read_number(sd_bus_message* message) {
  std::uint32_t number = 0;
  if (!enter_variant(message, "u")) return std::nullopt;
  const bool read = sd_bus_message_read_basic(message, SD_BUS_TYPE_UINT32, &number) > 0;
  sd_bus_message_exit_container(message);
  return read ? std::optional(number) : std::nullopt;
}

std::string read_text(sd_bus_message* message) {
  const char* text = nullptr;
  if (!enter_variant(message, "s")) return {};
  const bool read = sd_bus_message_read_basic(message, SD_BUS_TYPE_STRING, static_cast<void*>(&text)) > 0;
  sd_bus_message_exit_container(message);
  return read ? text : std::string{};
}

// Calls `see(key)` for each entry of the a{sv} before which `message` stands; it reads or skips the variant. False if
// there is no such dictionary.
template <typename See>
bool for_each_entry(sd_bus_message* message, See&& see) {
  if (sd_bus_message_enter_container(message, SD_BUS_TYPE_ARRAY, "{sv}") <= 0) return false;
  while (sd_bus_message_enter_container(message, SD_BUS_TYPE_DICT_ENTRY, "sv") > 0) {
    const char* key = nullptr;
    if (sd_bus_message_read_basic(message, SD_BUS_TYPE_STRING, static_cast<void*>(&key)) <= 0) return false;
    see(std::string_view(key));
    if (sd_bus_message_exit_container(message) < 0) return false;
  }
  return sd_bus_message_exit_container(message) >= 0;
}

std::vector<PortalStream> read_streams(sd_bus_message* message) {
  std::vector<PortalStream> streams;
  if (!enter_variant(message, "a(ua{sv})")) return streams;
  sd_bus_message_enter_container(message, SD_BUS_TYPE_ARRAY, "(ua{sv})");
  while (sd_bus_message_enter_container(message, SD_BUS_TYPE_STRUCT, "ua{sv}") > 0) {
    PortalStream stream;
    sd_bus_message_read_basic(message, SD_BUS_TYPE_UINT32, &stream.node);
    for_each_entry(message, [&](std::string_view key) {
      // Their size and place are not in px of the monitor but in what the desktop draws with.
      if (key == "source_type") {
        stream.source_type = read_number(message);
      } else {
        sd_bus_message_skip(message, "v");
      }
    });
    streams.push_back(stream);
    sd_bus_message_exit_container(message);
  }
  sd_bus_message_exit_container(message);
  sd_bus_message_exit_container(message);
  return streams;
}

}  // namespace

std::optional<PortalAbout> read_portal_about(sd_bus_message* message) {
  if (sd_bus_message_has_signature(message, "a{sv}") <= 0) return std::nullopt;
  PortalAbout about;
  const bool read = for_each_entry(message, [&](std::string_view key) {
    if (key == "version") {
      about.version = read_number(message).value_or(about.version);
    } else if (key == "AvailableSourceTypes") {
      about.source_types = read_number(message).value_or(0);
    } else if (key == "AvailableCursorModes") {
      about.cursor_modes = read_number(message).value_or(0);
    } else {
      sd_bus_message_skip(message, "v");
    }
  });
  return read ? std::optional(about) : std::nullopt;
}

std::optional<PortalResponse> read_portal_response(sd_bus_message* message) {
  PortalResponse response;
  if (sd_bus_message_has_signature(message, "ua{sv}") <= 0 ||
      sd_bus_message_read_basic(message, SD_BUS_TYPE_UINT32, &response.code) <= 0) {
    return std::nullopt;
  }
  const bool read = for_each_entry(message, [&](std::string_view key) {
    if (key == "session_handle") {
      // A string, by an old mistake of the interface that was kept.
      response.session = read_text(message);
    } else if (key == "streams") {
      response.streams = read_streams(message);
    } else if (key == "restore_token") {
      response.restore_token = read_text(message);
    } else {
      sd_bus_message_skip(message, "v");
    }
  });
  return read ? std::optional(std::move(response)) : std::nullopt;
}

}  // namespace telehug
