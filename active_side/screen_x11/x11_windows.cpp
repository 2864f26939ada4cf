// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_windows.hpp"

#include <algorithm>
#include <cctype>
#include <span>

#include "screen_x11/x11_properties.hpp"

namespace telehug {
namespace {

constexpr int deepest = 4;           // window managers put a program's window into one frame, or two
constexpr std::uint32_t iconic = 3;  // of WM_STATE

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

struct AskedNames {
  xcb_get_property_cookie_t utf8_title, title, classes;
};

bool has_name(const X11Connection& connection, const AskedNames& asked, const std::string& lower_text) {
  std::string title = read_x11_text(connection, asked.utf8_title);
  const std::string old_title = read_x11_text(connection, asked.title);
  if (title.empty()) {
    title = old_title;
  }
  const std::string classes = read_x11_text(connection, asked.classes);
  return lower(title).find(lower_text) != std::string::npos || lower(classes).find(lower_text) != std::string::npos;
}

std::span<const xcb_window_t> children(const xcb_query_tree_reply_t& tree) {
  return {xcb_query_tree_children(&tree), static_cast<std::size_t>(xcb_query_tree_children_length(&tree))};
}

bool is_shown(const xcb_get_window_attributes_reply_t& attributes) {
  return attributes.map_state == XCB_MAP_STATE_VIEWABLE && attributes._class == XCB_WINDOW_CLASS_INPUT_OUTPUT;
}

}  // namespace

X11Windows::X11Windows(const X11Connection& connection)
    : connection_(connection),
      stacking_(connection.atom("_NET_CLIENT_LIST_STACKING")),
      utf8_title_(connection.atom("_NET_WM_NAME")),
      wm_state_(connection.atom("WM_STATE")),
      net_state_(connection.atom("_NET_WM_STATE")),
      hidden_(connection.atom("_NET_WM_STATE_HIDDEN")) {}

std::vector<xcb_window_t> X11Windows::topmost_first() const {
  std::vector<xcb_window_t> windows =
      read_x11_values(connection_, ask_x11_property(connection_, connection_.root(), stacking_));
  std::reverse(windows.begin(), windows.end());
  if (!windows.empty()) {
    return windows;
  }
  // No window manager: all there is, level by level. What a program puts above the order of windows (menus, tooltips)
  // isn't its window, but a frame like that may hold one.
  xcb_connection_t* const server = connection_.get();
  std::vector<xcb_window_t> level{connection_.root()};
  for (int depth = 0; depth < deepest && !level.empty(); ++depth) {
    std::vector<xcb_query_tree_cookie_t> asked;
    asked.reserve(level.size());
    for (const xcb_window_t window : level) {
      asked.push_back(xcb_query_tree(server, window));
    }
    level.clear();
    for (const auto& cookie : asked) {
      const XcbOwned<xcb_query_tree_reply_t> tree(xcb_query_tree_reply(server, cookie, nullptr));
      if (tree) {
        const auto inner = children(*tree);
        level.insert(level.end(), inner.rbegin(), inner.rend());
      }
    }
    std::vector<xcb_get_window_attributes_cookie_t> asked_attributes;
    asked_attributes.reserve(level.size());
    for (const xcb_window_t window : level) {
      asked_attributes.push_back(xcb_get_window_attributes(server, window));
    }
    for (std::size_t i = 0; i < level.size(); ++i) {
      const XcbOwned<xcb_get_window_attributes_reply_t> attributes(
          xcb_get_window_attributes_reply(server, asked_attributes[i], nullptr));
      if (attributes && attributes->override_redirect == 0 && attributes->_class == XCB_WINDOW_CLASS_INPUT_OUTPUT) {
        windows.push_back(level[i]);
      }
    }
  }
  return windows;
}

std::vector<xcb_window_t> X11Windows::named(const std::string& text) const {
  std::vector<xcb_window_t> windows = topmost_first();
  std::vector<AskedNames> asked;
  asked.reserve(windows.size());
  for (const xcb_window_t window : windows) {
    asked.push_back({ask_x11_property(connection_, window, utf8_title_),
                     ask_x11_property(connection_, window, XCB_ATOM_WM_NAME),
                     ask_x11_property(connection_, window, XCB_ATOM_WM_CLASS)});
  }
  const std::string lower_text = lower(text);
  std::vector<xcb_window_t> found;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    if (has_name(connection_, asked[i], lower_text)) {
      found.push_back(windows[i]);
    }
  }
  return found;
}

std::optional<X11WindowPlace> X11Windows::place(xcb_window_t window) const {
  xcb_connection_t* const server = connection_.get();
  const auto asked_geometry = xcb_get_geometry(server, window);
  const auto asked_attributes = xcb_get_window_attributes(server, window);
  const auto asked_corner = xcb_translate_coordinates(server, window, connection_.root(), 0, 0);
  const auto asked_state = ask_x11_property(connection_, window, wm_state_);
  const auto asked_net_state = ask_x11_property(connection_, window, net_state_);
  const XcbOwned<xcb_get_geometry_reply_t> geometry(xcb_get_geometry_reply(server, asked_geometry, nullptr));
  const XcbOwned<xcb_get_window_attributes_reply_t> attributes(
      xcb_get_window_attributes_reply(server, asked_attributes, nullptr));
  const XcbOwned<xcb_translate_coordinates_reply_t> corner(
      xcb_translate_coordinates_reply(server, asked_corner, nullptr));
  const auto state = read_x11_values(connection_, asked_state);
  const auto net_state = read_x11_values(connection_, asked_net_state);
  if (!geometry || !attributes || !corner) {
    return std::nullopt;
  }
  // Some window managers keep minimised windows mapped and only say that they are.
  const bool minimised = (!state.empty() && state.front() == iconic) ||
                         std::find(net_state.begin(), net_state.end(), hidden_) != net_state.end();
  return X11WindowPlace{.inside_px = {corner->dst_x, corner->dst_y, geometry->width, geometry->height},
                        .border_px = geometry->border_width,
                        .depth = geometry->depth,
                        .visual = attributes->visual,
                        .shown = is_shown(*attributes) && !minimised};
}

}  // namespace telehug
