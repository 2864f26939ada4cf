// SPDX-License-Identifier: Apache-2.0
#include "overlay/x11_hotkey.hpp"

#include <fmt/format.h>

#include <utility>

#include "overlay/x11_key_grab.hpp"

namespace telehug {
namespace {

constexpr Duration between_tries = 1s;

}  // namespace

X11Hotkey::X11Hotkey(X11HotkeyConfig config, const Clock& clock) : config_(std::move(config)), clock_(clock) {}

X11Hotkey::~X11Hotkey() = default;

Status X11Hotkey::open() {
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

void X11Hotkey::close() {
  open_ = false;
  presses_ = 0;
  grab_.reset();
}

Status X11Hotkey::connect() {
  next_try_ = clock_.now() + between_tries;
  const auto combination = parse_key_combination(config_.keys);
  if (!combination) {
    return combination.error();
  }
  auto connection = X11Connection::open(config_.display);
  if (!connection) {
    return connection.error();
  }
  auto grab = std::make_unique<X11KeyGrab>(std::move(*connection), *combination, config_.keys);
  if (Status bound = grab->bind(); !bound) {
    return bound;
  }
  grab_ = std::move(grab);
  return Done{};
}

bool X11Hotkey::pressed() {
  if (!open_) {
    return false;
  }
  if (!grab_ && clock_.now() >= next_try_) {
    const Status connected = connect();
    last_error_ = connected ? "" : connected.error().message;
  }
  if (grab_) {
    presses_ += grab_->take_presses();
    const Status working = grab_->state();
    if (!working) {
      last_error_ = working.error().message;
      grab_.reset();
      next_try_ = clock_.now() + between_tries;
    }
  }
  if (presses_ == 0) {
    return false;
  }
  --presses_;
  return true;
}

}  // namespace telehug
