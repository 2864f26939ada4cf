// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xcb/xcb.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

#include "common/result.hpp"

namespace telehug {

struct FreeXcbMemory {
  void operator()(void* memory) const noexcept { std::free(memory); }
};

// What xcb hands over: a reply or an event.
template <typename Content>
using XcbOwned = std::unique_ptr<Content, FreeXcbMemory>;

// A connection to an X server. Once broken it stays so: requests do nothing and replies are null.
class X11Connection {
 public:
  // An empty `display` is $DISPLAY.
  static Result<X11Connection> open(const std::string& display);

  [[nodiscard]] xcb_connection_t* get() const noexcept { return connection_.get(); }
  [[nodiscard]] const std::string& display() const noexcept { return display_; }
  [[nodiscard]] const xcb_screen_t& screen() const noexcept { return *screen_; }
  [[nodiscard]] xcb_window_t root() const noexcept { return screen_->root; }
  [[nodiscard]] bool broken() const noexcept { return xcb_connection_has_error(connection_.get()) != 0; }

  // Is the server on this machine, so that memory can be shared with it?
  [[nodiscard]] bool is_local() const noexcept;

  // The next event that has come, or null; never waits. Errors of earlier requests are passed over: they concern
  // windows that went away meanwhile.
  [[nodiscard]] XcbOwned<xcb_generic_event_t> next_event() const noexcept;

  // 0 (XCB_ATOM_NONE) if the connection is broken.
  [[nodiscard]] xcb_atom_t atom(const std::string& name) const noexcept;

  // Null if the server doesn't have the extension.
  [[nodiscard]] const xcb_query_extension_reply_t* extension(xcb_extension_t& id) const noexcept;

 private:
  struct Disconnect {
    void operator()(xcb_connection_t* connection) const noexcept { xcb_disconnect(connection); }
  };

  std::string display_;
  std::unique_ptr<xcb_connection_t, Disconnect> connection_;
  const xcb_screen_t* screen_ = nullptr;  // lives as long as the connection
};

// Is it an event of this type, be it the server's own or one that a program sent?
[[nodiscard]] inline bool is_x11_event(const xcb_generic_event_t& event, int type) noexcept {
  return (event.response_type & 0x7F) == type;
}

}  // namespace telehug
