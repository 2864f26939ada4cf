// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "screen_x11/x11_connection.hpp"

namespace telehug {

// Properties of windows. Asking and reading are apart, so that many windows cost one wait for the server.
xcb_get_property_cookie_t ask_x11_property(const X11Connection& connection, xcb_window_t window, xcb_atom_t property);

// Its bytes if it is text, in whatever encoding; empty if there is none.
std::string read_x11_text(const X11Connection& connection, xcb_get_property_cookie_t asked);

// Its 32-bit values (window ids, atoms, states); empty if there are none or they have another form.
std::vector<std::uint32_t> read_x11_values(const X11Connection& connection, xcb_get_property_cookie_t asked);

}  // namespace telehug
