// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "screen_x11/x11_extensions.hpp"
#include "screen_x11/x11_stacking.hpp"

namespace telehug {

Result<std::unique_ptr<X11Watch>> X11Watch::connect(const X11GrabberConfig& config) {
  auto connection = X11Connection::open(config.display);
  if (!connection) {
    return connection.error();
  }
  if (const Status agreed = agree_on_x11_extensions(*connection); !agreed) {
    return agreed.error();
  }
  std::unique_ptr<X11Watch> watch(new X11Watch(std::move(*connection), config));
  if (const Status started = watch->start(); !started) {
    return started.error();
  }
  return watch;
}

X11Watch::X11Watch(X11Connection connection, const X11GrabberConfig& config)
    : connection_(std::move(connection)),
      config_(config),
      pixels_(connection_),
      windows_(connection_),
      monitor_news_(connection_) {}

Status X11Watch::start() {
  if (!config_.window.empty()) {
    monitor_news_.ask_for(XCB_EVENT_MASK_SUBSTRUCTURE_NOTIFY | XCB_EVENT_MASK_PROPERTY_CHANGE);
    return Done{};
  }
  monitor_news_.ask_for(XCB_EVENT_MASK_NO_EVENT);
  root_damage_.emplace(connection_, connection_.root());
  return check_x11_pixels(connection_, connection_.screen().root_depth, connection_.screen().root_visual);
}

void X11Watch::note(const xcb_generic_event_t& event) {
  if ((root_damage_ && root_damage_->note(event)) || (pinned_ && pinned_->damage().note(event))) {
    return;
  }
  monitors_stale_ = monitors_stale_ || monitor_news_.has(event);
  if (is_x11_event(event, XCB_PROPERTY_NOTIFY)) {
    const auto& property = reinterpret_cast<const xcb_property_notify_event_t&>(event);
    if (property.window == connection_.root() && property.atom != windows_.stacking()) {
      return;
    }
  }
  places_stale_ = true;
}

Result<X11View> X11Watch::look() {
  while (const auto event = connection_.next_event()) {
    note(*event);
  }
  if (monitors_stale_) {
    if (const Status found = find_monitor(); !found) {
      return found.error();
    }
  }
  if (places_stale_) {
    if (const Status found = config_.window.empty() ? Done{} : find_window(); !found) {
      return found.error();
    }
    places_stale_ = false;
  }
  return view_;
}

// Stays stale when it fails, so that the next look() tries again.
Status X11Watch::find_monitor() {
  const auto monitor = choose_x11_monitor(list_x11_monitors(connection_), config_.monitor);
  if (!monitor) {
    return monitor.error();
  }
  monitor_name_ = monitor->name;
  monitor_px_ = monitor->place_px;
  area_px_ = monitor_px_;
  if (config_.region) {
    // In 64 bits: the corner of a region from a config file may lie beyond what an int holds.
    using Wide = cv::Rect_<std::int64_t>;
    const Wide region = *config_.region;
    const Wide seen = (region + Wide(monitor_px_).tl()) & Wide(monitor_px_);
    if (seen.empty()) {
      return Error{fmt::format(
          "The region of {}x{} px at {},{} lies outside of the monitor {} ({}x{} px); correct the region.",
          region.width, region.height, region.x, region.y, monitor_name_, monitor_px_.width, monitor_px_.height)};
    }
    area_px_ = cv::Rect(seen);
  }
  view_ = {.window = connection_.root(),
           .part_px = area_px_,
           .origin_px = area_px_.tl() - monitor_px_.tl(),
           .monitor = {.width_px = monitor_px_.width, .height_px = monitor_px_.height},
           .in_front = std::nullopt};
  monitors_stale_ = false;
  places_stale_ = true;
  return Done{};
}

// The window that was found stays the one as long as it can be seen; else the topmost that can be.
Status X11Watch::find_window() {
  std::vector<xcb_window_t> candidates = windows_.named(config_.window);
  if (pinned_) {
    const auto held = std::find(candidates.begin(), candidates.end(), pinned_->id());
    if (held != candidates.end()) {
      std::rotate(candidates.begin(), held, held + 1);
    }
  }
  bool hidden = false;
  bool elsewhere = false;
  for (const xcb_window_t candidate : candidates) {
    const auto place = windows_.place(candidate);
    if (place && place->shown && !(place->inside_px & area_px_).empty()) {
      if (!pinned_ || pinned_->id() != candidate) {
        pinned_.emplace(connection_, candidate);
      }
      return place_view(*place);
    }
    hidden = hidden || (place && !place->shown);
    elsewhere = elsewhere || (place && place->shown);
  }
  if (elsewhere) {
    return lose_window(fmt::format("The window with \"{}\" in its title or class lies outside of {}; move it there.",
                                   config_.window,
                                   (config_.region ? "the region of monitor " : "monitor ") + monitor_name_));
  }
  if (hidden) {
    return lose_window(fmt::format(
        "The window with \"{}\" in its title or class is minimised or on another desktop; show it.", config_.window));
  }
  if (was_found_) {
    return lose_window(
        fmt::format("The window with \"{}\" in its title or class was closed; open the chat again.", config_.window));
  }
  return lose_window(
      fmt::format("No window has \"{}\" in its title or class; open the chat or correct the name.", config_.window));
}

Status X11Watch::lose_window(std::string why) {
  pinned_.reset();
  return Error{std::move(why)};
}

Status X11Watch::place_view(const X11WindowPlace& place) {
  if (const Status readable = check_x11_pixels(connection_, place.depth, place.visual); !readable) {
    return lose_window(readable.error().message);
  }
  const cv::Rect seen_px = place.inside_px & area_px_;
  border_px_ = place.border_px;
  view_.window = pinned_->id();
  view_.part_px = seen_px - place.inside_px.tl();
  view_.origin_px = seen_px.tl() - monitor_px_.tl();
  view_.in_front = is_in_front(connection_, pinned_->id(), place.inside_px & monitor_px_);
  pinned_->renew_pixmap();
  was_found_ = true;
  return Done{};
}

std::vector<cv::Rect> X11Watch::take_damage() {
  if (root_damage_) {
    return root_damage_->take(view_.part_px);
  }
  return pinned_ ? pinned_->damage().take(view_.part_px) : std::vector<cv::Rect>{};
}

cv::Mat X11Watch::read() {
  if (!pinned_) {
    return pixels_.read(view_.window, view_.part_px);
  }
  return pixels_.read(pinned_->pixmap(), view_.part_px + cv::Point(border_px_, border_px_));
}

}  // namespace telehug
