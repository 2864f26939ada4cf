// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xcb/shape.h>
#include <xcb/xcb.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace telehug {

struct X11WindowPlan {
  cv::Rect place_px = {0, 0, 100, 100};  // outer corner, inner size
  std::uint32_t colour = 0xFFFFFF;       // 0xRRGGBB
  std::string title = "window";
  std::string program = "program";  // WM_CLASS
  std::uint16_t border_px = 0;
  bool override_redirect = false;
  bool input_only = false;
  xcb_window_t parent = 0;  // 0: the root
  bool mapped = true;
};

// A program with windows on an X server. Every call returns after the server has done it.
class X11Client {
 public:
  explicit X11Client(const std::string& display) : connection_(xcb_connect(display.c_str(), nullptr)) {
    if (xcb_connection_has_error(connection_) != 0) throw std::runtime_error("no X server at " + display);
    screen_ = xcb_setup_roots_iterator(xcb_get_setup(connection_)).data;
  }
  ~X11Client() { xcb_disconnect(connection_); }
  X11Client(const X11Client&) = delete;
  X11Client& operator=(const X11Client&) = delete;

  [[nodiscard]] xcb_connection_t* get() const { return connection_; }
  [[nodiscard]] xcb_window_t root() const { return screen_->root; }

  void sync() { std::free(xcb_get_input_focus_reply(connection_, xcb_get_input_focus(connection_), nullptr)); }

  xcb_window_t open(const X11WindowPlan& plan) {
    const xcb_window_t window = xcb_generate_id(connection_);
    const auto [x, y, width, height] = words(plan.place_px);
    const auto parent = plan.parent != 0 ? plan.parent : root();
    const std::uint32_t override_redirect = plan.override_redirect ? 1 : 0;
    if (plan.input_only) {
      xcb_create_window(connection_, 0, window, parent, x, y, width, height, 0, XCB_WINDOW_CLASS_INPUT_ONLY,
                        screen_->root_visual, XCB_CW_OVERRIDE_REDIRECT, &override_redirect);
    } else {
      const std::array values{plan.colour, std::uint32_t{0x00FF00}, override_redirect};
      xcb_create_window(connection_, XCB_COPY_FROM_PARENT, window, parent, x, y, width, height, plan.border_px,
                        XCB_WINDOW_CLASS_INPUT_OUTPUT, screen_->root_visual,
                        XCB_CW_BACK_PIXEL | XCB_CW_BORDER_PIXEL | XCB_CW_OVERRIDE_REDIRECT, values.data());
    }
    set_text(window, XCB_ATOM_WM_NAME, plan.title);
    set_text(window, XCB_ATOM_WM_CLASS, plan.program + '\0' + plan.program + '\0');
    if (plan.mapped) xcb_map_window(connection_, window);
    sync();
    return window;
  }

  void set_text(xcb_window_t window, xcb_atom_t property, const std::string& text) {
    xcb_change_property(connection_, XCB_PROP_MODE_REPLACE, window, property, XCB_ATOM_STRING, 8,
                        static_cast<std::uint32_t>(text.size()), text.data());
    sync();
  }
  void set_values(xcb_window_t window, std::string_view property, xcb_atom_t type,
                  const std::vector<std::uint32_t>& values) {
    xcb_change_property(connection_, XCB_PROP_MODE_REPLACE, window, atom(property), type, 32,
                        static_cast<std::uint32_t>(values.size()), values.data());
    sync();
  }

  void fill(xcb_window_t window, const cv::Rect& area_px, std::uint32_t colour) {
    const xcb_gcontext_t context = xcb_generate_id(connection_);
    const auto [x, y, width, height] = words(area_px);
    const xcb_rectangle_t rectangle{x, y, width, height};
    xcb_create_gc(connection_, context, window, XCB_GC_FOREGROUND, &colour);
    xcb_poly_fill_rectangle(connection_, window, context, 1, &rectangle);
    xcb_free_gc(connection_, context);
    sync();
  }

  void move(xcb_window_t window, const cv::Point& corner_px) {
    const std::array values{static_cast<std::uint32_t>(corner_px.x), static_cast<std::uint32_t>(corner_px.y)};
    configure(window, XCB_CONFIG_WINDOW_X | XCB_CONFIG_WINDOW_Y, values.data());
  }
  void resize(xcb_window_t window, const cv::Size& size_px) {
    const std::array values{static_cast<std::uint32_t>(size_px.width), static_cast<std::uint32_t>(size_px.height)};
    configure(window, XCB_CONFIG_WINDOW_WIDTH | XCB_CONFIG_WINDOW_HEIGHT, values.data());
  }
  void raise(xcb_window_t window) {
    const std::uint32_t above = XCB_STACK_MODE_ABOVE;
    configure(window, XCB_CONFIG_WINDOW_STACK_MODE, &above);
  }
  void map(xcb_window_t window) {
    xcb_map_window(connection_, window);
    sync();
  }
  void unmap(xcb_window_t window) {
    xcb_unmap_window(connection_, window);
    sync();
  }
  void close(xcb_window_t window) {
    xcb_destroy_window(connection_, window);
    sync();
  }
  void let_clicks_through(xcb_window_t window) {
    xcb_shape_rectangles(connection_, XCB_SHAPE_SO_SET, XCB_SHAPE_SK_INPUT, XCB_CLIP_ORDERING_UNSORTED, window, 0, 0, 0,
                         nullptr);
    sync();
  }

  [[nodiscard]] xcb_atom_t atom(std::string_view name) {
    const std::unique_ptr<xcb_intern_atom_reply_t, decltype(&std::free)> reply(
        xcb_intern_atom_reply(connection_,
                              xcb_intern_atom(connection_, 0, static_cast<std::uint16_t>(name.size()), name.data()),
                              nullptr),
        &std::free);
    return reply->atom;
  }

  // What the screen shows, 0xRRGGBB.
  [[nodiscard]] std::uint32_t shown_at(const cv::Point& place_px) {
    return screenshot({place_px, cv::Size(1, 1)}).at<std::int32_t>(0, 0) & 0xFFFFFF;
  }
  // CV_32SC1, 0xRRGGBB
  [[nodiscard]] cv::Mat1i screenshot(const cv::Rect& area_px) {
    const auto [x, y, width, height] = words(area_px);
    const std::unique_ptr<xcb_get_image_reply_t, decltype(&std::free)> reply(
        xcb_get_image_reply(
            connection_,
            xcb_get_image(connection_, XCB_IMAGE_FORMAT_Z_PIXMAP, root(), x, y, width, height, ~std::uint32_t{0}),
            nullptr),
        &std::free);
    if (!reply) throw std::runtime_error("no screenshot");
    cv::Mat1i colours = cv::Mat(area_px.size(), CV_32SC1, xcb_get_image_data(reply.get())).clone();
    for (auto& colour : colours)
      colour &= 0xFFFFFF;
    return colours;
  }

 private:
  struct Words {
    std::int16_t x, y;
    std::uint16_t width, height;
  };
  static Words words(const cv::Rect& rect) {
    return {static_cast<std::int16_t>(rect.x), static_cast<std::int16_t>(rect.y),
            static_cast<std::uint16_t>(rect.width), static_cast<std::uint16_t>(rect.height)};
  }
  void configure(xcb_window_t window, std::uint16_t what, const std::uint32_t* values) {
    xcb_configure_window(connection_, window, what, values);
    sync();
  }

  xcb_connection_t* connection_;
  const xcb_screen_t* screen_ = nullptr;
};

}  // namespace telehug
