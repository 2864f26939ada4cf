// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/uio.h>
#include <xcb/randr.h>
#include <xcb/xcbext.h>

#include <array>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <string_view>

#include "doubles/x11_client.hpp"

namespace telehug {

// A monitor without an output, as xrandr --setmonitor makes one.
inline void set_monitor(X11Client& client, std::string_view name, const cv::Rect& place_px, bool primary = false) {
  struct Request {
    std::array<std::uint8_t, 4> head;  // filled in by xcb
    std::uint32_t window, name;
    std::uint8_t primary, automatic;
    std::uint16_t outputs;
    std::int16_t x, y;
    std::uint16_t width, height;
    std::uint32_t width_mm, height_mm;
  };
  Request request{.head = {},
                  .window = client.root(),
                  .name = client.atom(name),
                  .primary = static_cast<std::uint8_t>(primary),
                  .automatic = 0,
                  .outputs = 0,
                  .x = static_cast<std::int16_t>(place_px.x),
                  .y = static_cast<std::int16_t>(place_px.y),
                  .width = static_cast<std::uint16_t>(place_px.width),
                  .height = static_cast<std::uint16_t>(place_px.height),
                  .width_mm = 100,
                  .height_mm = 100};
  // Not xcb_randr_set_monitor(): that of libxcb 1.15 counts the request's length wrong.
  std::array<iovec, 3> parts{};  // xcb uses the two before the first
  parts[2] = {&request, sizeof(request)};
  const xcb_protocol_request_t kind{.count = 1, .ext = &xcb_randr_id, .opcode = XCB_RANDR_SET_MONITOR, .isvoid = 1};
  xcb_send_request(client.get(), 0, &parts[2], &kind);
  client.sync();
}

inline void delete_monitor(X11Client& client, std::string_view name) {
  xcb_randr_delete_monitor(client.get(), client.root(), client.atom(name));
  client.sync();
}

}  // namespace telehug
