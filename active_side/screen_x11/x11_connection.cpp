// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_connection.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

namespace telehug {

Result<X11Connection> X11Connection::open(const std::string& display) {
  const char* from_environment = std::getenv("DISPLAY");
  X11Connection opened;
  opened.display_ = !display.empty() || from_environment == nullptr ? display : from_environment;
  if (opened.display_.empty()) {
    return Error{
        "No X11 display is known (DISPLAY is not set); start telehug within the desktop session or name its display."};
  }
  int number = 0;
  opened.connection_.reset(xcb_connect(opened.display_.c_str(), &number));
  if (opened.broken()) {
    return Error{fmt::format(
        "The X11 display {} can't be reached; check that its session runs and that this user may use it (XAUTHORITY).",
        opened.display_)};
  }
  xcb_screen_iterator_t screens = xcb_setup_roots_iterator(xcb_get_setup(opened.get()));
  for (; screens.rem > 1 && number > 0; --number) {
    xcb_screen_next(&screens);
  }
  if (screens.rem < 1) {
    return Error{fmt::format("The X11 display {} has no screen; choose another.", opened.display_)};
  }
  opened.screen_ = screens.data;
  return opened;
}

bool X11Connection::is_local() const noexcept {
  sockaddr_storage address{};
  socklen_t length = sizeof(address);
  return getsockname(xcb_get_file_descriptor(get()), reinterpret_cast<sockaddr*>(&address), &length) == 0 &&
         address.ss_family == AF_UNIX;
}

XcbOwned<xcb_generic_event_t> X11Connection::next_event() const noexcept {
  XcbOwned<xcb_generic_event_t> event(xcb_poll_for_event(get()));
  while (event && event->response_type == 0) {
    event.reset(xcb_poll_for_event(get()));
  }
  return event;
}

xcb_atom_t X11Connection::atom(const std::string& name) const noexcept {
  const XcbOwned<xcb_intern_atom_reply_t> reply(xcb_intern_atom_reply(
      get(), xcb_intern_atom(get(), 0, static_cast<std::uint16_t>(name.size()), name.data()), nullptr));
  return reply ? reply->atom : xcb_atom_t{XCB_ATOM_NONE};
}

const xcb_query_extension_reply_t* X11Connection::extension(xcb_extension_t& id) const noexcept {
  const xcb_query_extension_reply_t* reply = xcb_get_extension_data(get(), &id);
  return reply != nullptr && reply->present != 0 ? reply : nullptr;
}

}  // namespace telehug
