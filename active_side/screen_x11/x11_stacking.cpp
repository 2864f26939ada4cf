// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_stacking.hpp"

#include <xcb/shape.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "screen_x11/x11_properties.hpp"

namespace telehug {
namespace {

constexpr int deepest = 8;             // frames that a window manager may have put about a window
constexpr double hidden_share = 0.05;  // more of a window hidden, as by a dialogue: it isn't in front

// WM_CLASS holds two names, each ended by a 0: of the program's copy and of the program.
bool has_class(std::string_view classes, std::string_view name) {
  while (!classes.empty()) {
    const auto end = std::min(classes.find('\0'), classes.size());
    if (classes.substr(0, end) == name) {
      return true;
    }
    classes.remove_prefix(std::min(end + 1, classes.size()));
  }
  return false;
}

struct AskedCover {
  xcb_get_window_attributes_cookie_t attributes;
  xcb_get_geometry_cookie_t geometry;
  xcb_get_property_cookie_t classes;
  xcb_shape_get_rectangles_cookie_t clickable;
};

AskedCover ask_cover(const X11Connection& connection, xcb_window_t window) {
  return {xcb_get_window_attributes(connection.get(), window), xcb_get_geometry(connection.get(), window),
          ask_x11_property(connection, window, XCB_ATOM_WM_CLASS),
          xcb_shape_get_rectangles(connection.get(), window, XCB_SHAPE_SK_INPUT)};
}

// How many px of `part_px` a window at the top of the tree hides.
int hidden_px(const X11Connection& connection, const AskedCover& asked, const cv::Rect& part_px) {
  xcb_connection_t* const server = connection.get();
  const XcbOwned<xcb_get_window_attributes_reply_t> attributes(
      xcb_get_window_attributes_reply(server, asked.attributes, nullptr));
  const XcbOwned<xcb_get_geometry_reply_t> geometry(xcb_get_geometry_reply(server, asked.geometry, nullptr));
  const std::string classes = read_x11_text(connection, asked.classes);
  const XcbOwned<xcb_shape_get_rectangles_reply_t> clickable(
      xcb_shape_get_rectangles_reply(server, asked.clickable, nullptr));
  if (!attributes || !geometry || !clickable || attributes->map_state != XCB_MAP_STATE_VIEWABLE ||
      attributes->_class != XCB_WINDOW_CLASS_INPUT_OUTPUT || has_class(classes, x11_own_class)) {
    return 0;
  }
  const int border = geometry->border_width;
  const cv::Point inside(geometry->x + border, geometry->y + border);
  const cv::Rect seen_px =
      part_px & cv::Rect(geometry->x, geometry->y, geometry->width + 2 * border, geometry->height + 2 * border);
  int hidden = 0;
  const xcb_rectangle_t* part = xcb_shape_get_rectangles_rectangles(clickable.get());
  for (int left = xcb_shape_get_rectangles_rectangles_length(clickable.get()); left > 0; --left, ++part) {
    hidden += (seen_px & cv::Rect(inside + cv::Point(part->x, part->y), cv::Size(part->width, part->height))).area();
  }
  return hidden;
}

// The windows at the top of the tree that lie above the one that holds `window`; none if `window` is gone.
std::optional<std::vector<xcb_window_t>> windows_above(const X11Connection& connection, xcb_window_t window) {
  xcb_connection_t* const server = connection.get();
  xcb_window_t top = window;
  for (int depth = 0; depth < deepest; ++depth) {
    const XcbOwned<xcb_query_tree_reply_t> tree(xcb_query_tree_reply(server, xcb_query_tree(server, top), nullptr));
    if (!tree) {
      return std::nullopt;
    }
    if (tree->parent == connection.root()) {
      break;
    }
    top = tree->parent;
  }
  const XcbOwned<xcb_query_tree_reply_t> tree(
      xcb_query_tree_reply(server, xcb_query_tree(server, connection.root()), nullptr));
  if (!tree) {
    return std::nullopt;
  }
  const xcb_window_t* const bottom = xcb_query_tree_children(tree.get());
  const xcb_window_t* const end = bottom + xcb_query_tree_children_length(tree.get());
  const xcb_window_t* const own = std::find(bottom, end, top);
  return own == end ? std::nullopt : std::optional(std::vector<xcb_window_t>(own + 1, end));
}

}  // namespace

bool is_in_front(const X11Connection& connection, xcb_window_t window, const cv::Rect& part_px) {
  const auto above = windows_above(connection, window);
  if (!above) {
    return false;
  }
  std::vector<AskedCover> asked;
  asked.reserve(above->size());
  for (const xcb_window_t other : *above) {
    asked.push_back(ask_cover(connection, other));
  }
  // Where two windows lie above one another it counts twice, which errs to the safe side.
  int all_hidden_px = 0;
  for (const AskedCover& cover : asked) {
    all_hidden_px += hidden_px(connection, cover, part_px);
  }
  return all_hidden_px <= hidden_share * part_px.area();
}

}  // namespace telehug
