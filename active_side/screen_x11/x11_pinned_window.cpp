// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_pinned_window.hpp"

#include <xcb/composite.h>

#include <cstdint>

namespace telehug {
namespace {

void select_events(const X11Connection& connection, xcb_window_t window, std::uint32_t mask) {
  xcb_change_window_attributes(connection.get(), window, XCB_CW_EVENT_MASK, &mask);
}

}  // namespace

X11PinnedWindow::X11PinnedWindow(const X11Connection& connection, xcb_window_t window)
    : connection_(connection), window_(window), damage_(connection, window) {
  select_events(connection_, window_, XCB_EVENT_MASK_STRUCTURE_NOTIFY | XCB_EVENT_MASK_PROPERTY_CHANGE);
  xcb_composite_redirect_window(connection_.get(), window_, XCB_COMPOSITE_REDIRECT_AUTOMATIC);
}

X11PinnedWindow::~X11PinnedWindow() {
  if (pixmap_ != 0) {
    xcb_free_pixmap(connection_.get(), pixmap_);
  }
  xcb_composite_unredirect_window(connection_.get(), window_, XCB_COMPOSITE_REDIRECT_AUTOMATIC);
  select_events(connection_, window_, XCB_EVENT_MASK_NO_EVENT);
}

void X11PinnedWindow::renew_pixmap() {
  if (pixmap_ != 0) {
    xcb_free_pixmap(connection_.get(), pixmap_);
  }
  pixmap_ = xcb_generate_id(connection_.get());
  xcb_composite_name_window_pixmap(connection_.get(), window_, pixmap_);
}

}  // namespace telehug
