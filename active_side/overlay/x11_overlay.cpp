// SPDX-License-Identifier: Apache-2.0
#include "overlay/x11_overlay.hpp"

#include <fmt/format.h>

#include <utility>

#include "overlay/outline.hpp"

namespace telehug {
namespace {

constexpr Duration between_tries = 1s;
constexpr std::uint32_t touched_rgb = 0xE53935;
constexpr std::uint32_t felt_rgb = 0x43A047;
constexpr std::uint32_t hugged_rgb = 0xEC407A;

std::uint32_t rgb_of(OverlayState state) {
  switch (state) {
    case OverlayState::touched:
      return touched_rgb;
    case OverlayState::felt:
      return felt_rgb;
    case OverlayState::hugged:
      return hugged_rgb;
  }
  return touched_rgb;
}

}  // namespace

X11Overlay::X11Overlay(X11OverlayConfig config, const Clock& clock) : config_(std::move(config)), clock_(clock) {}

Status X11Overlay::open() {
  if (open_) {
    return Done{};
  }
  Status connected = connect();
  if (connected) {
    open_ = true;
    last_error_.clear();
  }
  return connected;
}

void X11Overlay::close() {
  open_ = false;
  box_px_.reset();
  window_.reset();
}

Status X11Overlay::connect() {
  next_try_ = clock_.now() + between_tries;
  auto window = X11OutlineWindow::create(config_.display, config_.monitor);
  if (!window) {
    return window.error();
  }
  window_ = std::move(*window);
  return Done{};
}

void X11Overlay::show(const cv::Rect& box_px, OverlayState state) {
  box_px_ = box_px;
  state_ = state;
  update();
}

void X11Overlay::hide() {
  box_px_.reset();
  update();
}

void X11Overlay::update() {
  if (!open_) {
    return;
  }
  if (!window_) {
    if (!box_px_ || clock_.now() < next_try_) {
      return;
    }
    if (const Status connected = connect(); !connected) {
      last_error_ = connected.error().message;
      return;
    }
  }
  const Status followed = window_->follow();
  last_error_ = followed ? "" : followed.error().message;
  if (followed && box_px_) {
    const int width_px = state_ == OverlayState::touched ? config_.line_px : 2 * config_.line_px;
    const cv::Rect bounds({}, window_->monitor_px().size());
    window_->show(make_outline(*box_px_, width_px, bounds), rgb_of(state_), clock_.now());
  } else {
    window_->hide();
  }
  if (window_->broken()) {
    last_error_ = fmt::format("The X11 display {} is gone; start its session again.", window_->display());
    window_.reset();
  }
}

std::vector<cv::Rect> X11Overlay::areas() const {
  if (!window_ || !box_px_) {
    return {};
  }
  return make_outline(*box_px_, 2 * config_.line_px, cv::Rect({}, window_->monitor_px().size()));
}

}  // namespace telehug
