// SPDX-License-Identifier: Apache-2.0
#include "overlay/x11_outline_window.hpp"

#include <xcb/shape.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "screen_x11/x11_extensions.hpp"
#include "screen_x11/x11_stacking.hpp"

namespace telehug {
namespace {

constexpr Duration between_raises = 1s;  // another program may want to be above, too

std::uint16_t channel(std::uint32_t rgb, int shift) {
  return static_cast<std::uint16_t>(((rgb >> shift) & 0xFF) * 0x101);
}

}  // namespace

Result<std::unique_ptr<X11OutlineWindow>> X11OutlineWindow::create(const std::string& display,
                                                                   const std::string& monitor) {
  auto connection = X11Connection::open(display);
  if (!connection) {
    return connection.error();
  }
  if (const Status agreed = agree_on_x11_extensions(*connection); !agreed) {
    return agreed.error();
  }
  std::unique_ptr<X11OutlineWindow> window(new X11OutlineWindow(std::move(*connection), monitor));
  window->make_window();
  return window;
}

X11OutlineWindow::X11OutlineWindow(X11Connection connection, std::string monitor)
    : connection_(std::move(connection)), monitor_(std::move(monitor)), news_(connection_) {
  news_.ask_for(XCB_EVENT_MASK_NO_EVENT);
}

void X11OutlineWindow::make_window() {
  xcb_connection_t* const server = connection_.get();
  window_ = xcb_generate_id(server);
  const std::array<std::uint32_t, 2> values{1, XCB_EVENT_MASK_VISIBILITY_CHANGE};
  xcb_create_window(server, XCB_COPY_FROM_PARENT, window_, connection_.root(), 0, 0, 1, 1, 0,
                    XCB_WINDOW_CLASS_INPUT_OUTPUT, connection_.screen().root_visual,
                    XCB_CW_OVERRIDE_REDIRECT | XCB_CW_EVENT_MASK, values.data());
  const std::string name = x11_own_class;
  const std::string classes = name + '\0' + name + '\0';
  xcb_change_property(server, XCB_PROP_MODE_REPLACE, window_, XCB_ATOM_WM_NAME, XCB_ATOM_STRING, 8,
                      static_cast<std::uint32_t>(name.size()), name.data());
  xcb_change_property(server, XCB_PROP_MODE_REPLACE, window_, XCB_ATOM_WM_CLASS, XCB_ATOM_STRING, 8,
                      static_cast<std::uint32_t>(classes.size()), classes.data());
  xcb_shape_rectangles(server, XCB_SHAPE_SO_SET, XCB_SHAPE_SK_INPUT, XCB_CLIP_ORDERING_UNSORTED, window_, 0, 0, 0,
                       nullptr);
}

Status X11OutlineWindow::follow() {
  while (const auto event = connection_.next_event()) {
    if (is_x11_event(*event, XCB_VISIBILITY_NOTIFY)) {
      const auto& visibility = reinterpret_cast<const xcb_visibility_notify_event_t&>(*event);
      obscured_ = visibility.state != XCB_VISIBILITY_UNOBSCURED;
    }
    monitors_stale_ = monitors_stale_ || news_.has(*event);
  }
  if (monitors_stale_) {
    const auto monitor = choose_x11_monitor(list_x11_monitors(connection_), monitor_);
    if (!monitor) {
      return monitor.error();
    }
    monitor_px_ = monitor->place_px;
    monitors_stale_ = false;
  }
  return Done{};
}

std::uint32_t X11OutlineWindow::colour(std::uint32_t rgb) {
  const auto asked = xcb_alloc_color(connection_.get(), connection_.screen().default_colormap, channel(rgb, 16),
                                     channel(rgb, 8), channel(rgb, 0));
  const XcbOwned<xcb_alloc_color_reply_t> reply(xcb_alloc_color_reply(connection_.get(), asked, nullptr));
  return reply ? reply->pixel : connection_.screen().white_pixel;
}

void X11OutlineWindow::show(const std::vector<cv::Rect>& lines_px, std::uint32_t rgb, Timestamp now) {
  if (lines_px.empty()) {
    hide();
    return;
  }
  std::vector<cv::Rect> lines;
  cv::Rect whole;
  for (const cv::Rect& line : lines_px) {
    lines.push_back(line + monitor_px_.tl());
    whole |= lines.back();
  }
  const bool raise = obscured_ && now >= raised_ + between_raises;
  if (lines == shown_px_ && rgb == shown_rgb_ && !raise) {
    return;
  }
  std::vector<xcb_rectangle_t> shape;
  for (const cv::Rect& line : lines) {
    const cv::Rect inside = line - whole.tl();
    shape.push_back({static_cast<std::int16_t>(inside.x), static_cast<std::int16_t>(inside.y),
                     static_cast<std::uint16_t>(inside.width), static_cast<std::uint16_t>(inside.height)});
  }
  xcb_connection_t* const server = connection_.get();
  const std::uint32_t pixel = colour(rgb);
  const std::array place{static_cast<std::uint32_t>(whole.x), static_cast<std::uint32_t>(whole.y),
                         static_cast<std::uint32_t>(whole.width), static_cast<std::uint32_t>(whole.height),
                         static_cast<std::uint32_t>(XCB_STACK_MODE_ABOVE)};
  if (whole != shown_whole_px_) {
    hide();  // else the new lines would be seen at the old place for a moment
  }
  xcb_change_window_attributes(server, window_, XCB_CW_BACK_PIXEL, &pixel);
  xcb_shape_rectangles(server, XCB_SHAPE_SO_SET, XCB_SHAPE_SK_BOUNDING, XCB_CLIP_ORDERING_UNSORTED, window_, 0, 0,
                       static_cast<std::uint32_t>(shape.size()), shape.data());
  xcb_configure_window(server, window_,
                       XCB_CONFIG_WINDOW_X | XCB_CONFIG_WINDOW_Y | XCB_CONFIG_WINDOW_WIDTH | XCB_CONFIG_WINDOW_HEIGHT |
                           XCB_CONFIG_WINDOW_STACK_MODE,
                       place.data());
  xcb_map_window(server, window_);
  xcb_clear_area(server, 0, window_, 0, 0, 0, 0);  // paints it all in the new colour
  xcb_flush(server);
  shown_px_ = std::move(lines);
  shown_whole_px_ = whole;
  shown_rgb_ = rgb;
  raised_ = now;
  obscured_ = false;
}

void X11OutlineWindow::hide() {
  if (!shown_px_.empty()) {
    xcb_unmap_window(connection_.get(), window_);
    xcb_flush(connection_.get());
    shown_px_.clear();
    shown_whole_px_ = {};
  }
}

}  // namespace telehug
