// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_properties.hpp"

#include <cstring>

namespace telehug {
namespace {

constexpr std::uint32_t most_words = 4096;  // of 4 bytes; longer ones are cut

using Property = XcbOwned<xcb_get_property_reply_t>;

Property read(const X11Connection& connection, xcb_get_property_cookie_t asked) {
  return Property(xcb_get_property_reply(connection.get(), asked, nullptr));
}

}  // namespace

xcb_get_property_cookie_t ask_x11_property(const X11Connection& connection, xcb_window_t window, xcb_atom_t property) {
  return xcb_get_property(connection.get(), 0, window, property, XCB_GET_PROPERTY_TYPE_ANY, 0, most_words);
}

std::string read_x11_text(const X11Connection& connection, xcb_get_property_cookie_t asked) {
  const Property property = read(connection, asked);
  if (!property || property->format != 8) {
    return {};
  }
  const auto bytes = static_cast<std::size_t>(xcb_get_property_value_length(property.get()));
  return {static_cast<const char*>(xcb_get_property_value(property.get())), bytes};
}

std::vector<std::uint32_t> read_x11_values(const X11Connection& connection, xcb_get_property_cookie_t asked) {
  const Property property = read(connection, asked);
  if (!property || property->format != 32) {
    return {};
  }
  const auto bytes = static_cast<std::size_t>(xcb_get_property_value_length(property.get()));
  std::vector<std::uint32_t> values(bytes / sizeof(std::uint32_t));
  if (!values.empty()) {
    std::memcpy(values.data(), xcb_get_property_value(property.get()), values.size() * sizeof(std::uint32_t));
  }
  return values;
}

}  // namespace telehug
