// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_grabber.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>

namespace telehug {
namespace {

constexpr Duration between_tries = 1s;
constexpr int most_black_grabs = 3;

bool same_place(const X11View& one, const X11View& other) {
  return one.window == other.window && one.part_px == other.part_px && one.origin_px == other.origin_px &&
         one.monitor.width_px == other.monitor.width_px && one.monitor.height_px == other.monitor.height_px;
}

bool is_black(const cv::Mat& bgrx) {
  constexpr std::uint32_t colours = 0xFFFFFF;  // check_x11_pixels() lets only this order of bytes through
  for (int row = 0; row < bgrx.rows; ++row) {
    const auto* pixels = bgrx.ptr<std::uint32_t>(row);
    if (std::any_of(pixels, pixels + bgrx.cols, [](std::uint32_t pixel) { return (pixel & colours) != 0; })) {
      return false;
    }
  }
  return true;
}

}  // namespace

X11Grabber::X11Grabber(X11GrabberConfig config, const Clock& clock) : config_(std::move(config)), clock_(clock) {}

Status X11Grabber::open() {
  if (open_) {
    return Done{};
  }
  Status connected = connect();
  if (connected) {
    open_ = true;
    last_error_.clear();
    black_grabs_ = 0;
    const char* wayland = std::getenv("WAYLAND_DISPLAY");
    on_wayland_ = wayland != nullptr && *wayland != '\0';
  }
  return connected;
}

void X11Grabber::close() {
  open_ = false;
  shown_.reset();
  pixels_.release();
  kept_ = {};
  watch_.reset();
}

Status X11Grabber::connect() {
  next_try_ = clock_.now() + between_tries;
  auto watch = X11Watch::connect(config_);
  if (!watch) {
    return watch.error();
  }
  watch_ = std::move(*watch);
  return Done{};
}

GrabOutcome X11Grabber::lose(std::string why) {
  shown_.reset();
  last_error_ = std::move(why);
  return GrabOutcome::lost;
}

GrabOutcome X11Grabber::grab(ScreenPicture& picture) {
  picture.time = clock_.now();
  if (!open_) {
    return lose(fmt::format("{} is not open.", name()));
  }
  if (!watch_) {
    if (picture.time < next_try_) {
      return GrabOutcome::lost;
    }
    if (const Status connected = connect(); !connected) {
      return lose(connected.error().message);
    }
  }
  const GrabOutcome outcome = grab_from(*watch_, picture);
  if (!watch_->broken()) {
    return outcome;
  }
  const std::string display = watch_->display();
  pixels_.release();
  picture.bgr.release();  // may lie in memory that goes away now
  watch_.reset();
  return lose(fmt::format("The X11 display {} is gone; start its session again.", display));
}

GrabOutcome X11Grabber::grab_from(X11Watch& watch, ScreenPicture& picture) {
  auto view = watch.look();
  if (!view) {
    return lose(view.error().message);
  }
  picture.in_front = view->in_front;
  const bool drawn_in = is_drawn_in(*view, watch.take_damage());
  if (shown_ && same_place(*shown_, *view) && !drawn_in && !stale_) {
    return judge_black(GrabOutcome::unchanged);
  }
  cv::Mat pixels = read_keeping(watch, *view);
  if (pixels.empty()) {
    // The window may have got another size or gone since it was looked at.
    watch.forget_place();
    view = watch.look();
    if (!view) {
      return lose(view.error().message);
    }
    pixels = read_keeping(watch, *view);
  }
  if (pixels.empty()) {
    return lose(fmt::format("{} can't be read now; if that lasts, start telehug again.", name()));
  }
  picture.bgr = pixels;
  picture.origin_px = view->origin_px;
  picture.monitor = view->monitor;
  picture.in_front = view->in_front;
  black_ = on_wayland_ && config_.window.empty() && is_black(pixels);
  pixels_ = std::move(pixels);
  shown_ = *view;
  stale_ = false;
  return judge_black(GrabOutcome::changed);
}

bool X11Grabber::is_drawn_in(const X11View& view, const std::vector<cv::Rect>& damage_px) {
  const cv::Point to_monitor = view.origin_px - view.part_px.tl();
  const std::span<const cv::Rect> areas = config_.window.empty() ? left_out_px_ : std::span<const cv::Rect>();
  bool drawn_in = false;
  for (const cv::Rect& damage : damage_px) {
    const cv::Rect seen = damage & view.part_px;
    if (!seen.empty()) {
      const bool ignored = is_covered(seen + to_monitor, areas);
      drawn_in = drawn_in || !ignored;
      left_out_drawn_ = left_out_drawn_ || ignored;
    }
  }
  return drawn_in;
}

// The left-out areas of a picture of the same place are set aside while the server fills its memory anew.
cv::Mat X11Grabber::read_keeping(X11Watch& watch, const X11View& view) {
  std::vector<cv::Rect> areas;
  if (config_.window.empty() && shown_ && same_place(*shown_, view)) {
    for (const cv::Rect& area : left_out_px_) {
      areas.push_back(area - view.origin_px);
    }
  }
  kept_.keep(pixels_, areas);
  cv::Mat pixels = watch.read();
  if (!pixels.empty()) {
    kept_.put_back(pixels);
  }
  return pixels;
}

void X11Grabber::leave_out(const std::vector<cv::Rect>& areas_px) {
  if (areas_px == left_out_px_) {
    return;
  }
  stale_ = stale_ || left_out_drawn_;  // what was passed over there may count again
  left_out_drawn_ = left_out_drawn_ && !areas_px.empty();
  left_out_px_ = areas_px;
}

// XWayland shows a black root window, for windows of Wayland are none of its own.
GrabOutcome X11Grabber::judge_black(GrabOutcome outcome) {
  black_grabs_ = black_ ? std::min(black_grabs_ + 1, most_black_grabs) : 0;
  if (black_grabs_ < most_black_grabs) {
    return outcome;
  }
  return lose("The X11 screen is black since this is a Wayland session; set body_map.source to portal.");
}

std::string X11Grabber::name() const {
  if (!config_.window.empty()) {
    return fmt::format("X11 window \"{}\"", config_.window);
  }
  return config_.monitor.empty() ? "X11 monitor" : fmt::format("X11 monitor {}", config_.monitor);
}

}  // namespace telehug
