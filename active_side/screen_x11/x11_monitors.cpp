// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_monitors.hpp"

#include <fmt/format.h>
#include <xcb/randr.h>

#include <algorithm>
#include <utility>

namespace telehug {
namespace {

std::string atom_name(xcb_connection_t* connection, xcb_atom_t atom) {
  const XcbOwned<xcb_get_atom_name_reply_t> reply(
      xcb_get_atom_name_reply(connection, xcb_get_atom_name(connection, atom), nullptr));
  if (!reply) {
    return {};
  }
  return {xcb_get_atom_name_name(reply.get()), static_cast<std::size_t>(xcb_get_atom_name_name_length(reply.get()))};
}

}  // namespace

std::vector<X11Monitor> list_x11_monitors(const X11Connection& connection) {
  xcb_connection_t* const server = connection.get();
  const auto asked_root = xcb_get_geometry(server, connection.root());
  const auto asked_monitors = xcb_randr_get_monitors(server, connection.root(), 1);
  const XcbOwned<xcb_get_geometry_reply_t> root(xcb_get_geometry_reply(server, asked_root, nullptr));
  const XcbOwned<xcb_randr_get_monitors_reply_t> reply(xcb_randr_get_monitors_reply(server, asked_monitors, nullptr));
  std::vector<X11Monitor> monitors;
  if (!root || !reply) {
    return monitors;
  }
  const cv::Rect whole(0, 0, root->width, root->height);
  auto entry = xcb_randr_get_monitors_monitors_iterator(reply.get());
  for (; entry.rem > 0; xcb_randr_monitor_info_next(&entry)) {
    const xcb_randr_monitor_info_t& info = *entry.data;
    X11Monitor monitor{.name = atom_name(server, info.name),
                       .primary = info.primary != 0,
                       .place_px = cv::Rect(info.x, info.y, info.width, info.height) & whole,
                       .width_mm = info.width_in_millimeters,
                       .height_mm = info.height_in_millimeters};
    const auto* const outputs = xcb_randr_monitor_info_outputs(entry.data);
    monitor.outputs.assign(outputs, outputs + xcb_randr_monitor_info_outputs_length(entry.data));
    if (!monitor.place_px.empty()) {
      monitors.push_back(std::move(monitor));
    }
  }
  return monitors;
}

Result<X11Monitor> choose_x11_monitor(const std::vector<X11Monitor>& monitors, const std::string& name) {
  if (monitors.empty()) {
    return Error{"The X11 display shows no monitor; switch one on."};
  }
  const auto chosen = std::find_if(monitors.begin(), monitors.end(), [&name](const X11Monitor& monitor) {
    return name.empty() ? monitor.primary : monitor.name == name;
  });
  if (chosen != monitors.end()) {
    return *chosen;
  }
  if (name.empty()) {
    return monitors.front();
  }
  std::string there;
  for (const X11Monitor& monitor : monitors) {
    there += (there.empty() ? "" : ", ") + monitor.name;
  }
  return Error{fmt::format("There is no monitor {}; plug it in or choose one of these: {}.", name, there)};
}

void X11MonitorNews::ask_for(std::uint32_t further_events) {
  if (const auto* extension = connection_.extension(xcb_randr_id)) {
    first_event_ = extension->first_event;
  }
  xcb_randr_select_input(
      connection_.get(), connection_.root(),
      XCB_RANDR_NOTIFY_MASK_SCREEN_CHANGE | XCB_RANDR_NOTIFY_MASK_CRTC_CHANGE | XCB_RANDR_NOTIFY_MASK_OUTPUT_CHANGE);
  const std::uint32_t events = XCB_EVENT_MASK_STRUCTURE_NOTIFY | further_events;
  xcb_change_window_attributes(connection_.get(), connection_.root(), XCB_CW_EVENT_MASK, &events);
}

bool X11MonitorNews::has(const xcb_generic_event_t& event) const noexcept {
  if (is_x11_event(event, first_event_ + XCB_RANDR_SCREEN_CHANGE_NOTIFY) ||
      is_x11_event(event, first_event_ + XCB_RANDR_NOTIFY)) {
    return true;
  }
  // Monitors that somebody has laid out by hand are told of by the root window alone.
  return is_x11_event(event, XCB_CONFIGURE_NOTIFY) &&
         reinterpret_cast<const xcb_configure_notify_event_t&>(event).window == connection_.root();
}

}  // namespace telehug
