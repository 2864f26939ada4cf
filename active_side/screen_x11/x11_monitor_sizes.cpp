// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_monitor_sizes.hpp"

#include <xcb/randr.h>

#include <algorithm>
#include <utility>

namespace telehug {
namespace {

constexpr std::uint32_t most_edid_words = 128;  // 4 blocks

std::optional<MonitorMm> size_in_edid(const X11Connection& connection, xcb_randr_output_t output) {
  const xcb_atom_t edid = connection.atom("EDID");
  if (edid == XCB_ATOM_NONE) return std::nullopt;
  const auto asked = xcb_randr_get_output_property(connection.get(), output, edid, XCB_ATOM_ANY, 0, most_edid_words,
                                                   0 /* keep it */, 0 /* as it is */);
  const XcbOwned<xcb_randr_get_output_property_reply_t> reply(
      xcb_randr_get_output_property_reply(connection.get(), asked, nullptr));
  if (!reply || reply->format != 8) return std::nullopt;
  return monitor_size_in_edid({xcb_randr_get_output_property_data(reply.get()),
                               static_cast<std::size_t>(xcb_randr_get_output_property_data_length(reply.get()))});
}

MonitorMm as_it_stands(MonitorMm size, const cv::Rect& place_px) {
  const bool upright = place_px.height > place_px.width;
  if (upright != (size.height_mm > size.width_mm)) std::swap(size.width_mm, size.height_mm);
  return size;
}

SizedMonitor sized(const X11Connection& connection, X11Monitor monitor) {
  // Of several that show one picture none is the monitor's size.
  const auto edid =
      monitor.outputs.size() == 1 ? size_in_edid(connection, monitor.outputs.front()) : std::optional<MonitorMm>();
  if (edid) {
    const MonitorMm standing = as_it_stands(*edid, monitor.place_px);
    return {std::move(monitor), standing, MonitorSizeFrom::edid};
  }
  const MonitorMm told{static_cast<double>(monitor.width_mm), static_cast<double>(monitor.height_mm)};
  if (told.width_mm > 0 && told.height_mm > 0) return {std::move(monitor), told, MonitorSizeFrom::randr};
  return {std::move(monitor), {}, MonitorSizeFrom::nowhere};
}

}  // namespace

std::vector<SizedMonitor> list_sized_x11_monitors(const X11Connection& connection) {
  std::vector<SizedMonitor> monitors;
  for (X11Monitor& monitor : list_x11_monitors(connection))
    monitors.push_back(sized(connection, std::move(monitor)));
  return monitors;
}

const char* name_of(MonitorSizeFrom from) noexcept {
  switch (from) {
    case MonitorSizeFrom::edid:
      return "edid";
    case MonitorSizeFrom::randr:
      return "randr";
    case MonitorSizeFrom::nowhere:
      break;
  }
  return "nowhere";
}

}  // namespace telehug
