// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/frame_slot.hpp"

#include <utility>

namespace telehug {

void FrameSlot::put(const FrameInMemory& frame, GiveBack give_back) {
  auto found = find_frame(frame);
  const std::lock_guard lock(mutex_);
  let_go();
  taken_ = false;
  if (!found) {
    spoiled_ = found.error().message;
    give_back();
    return;
  }
  spoiled_.reset();
  held_ = Held{std::move(*found), frame.order, frame.data, std::move(give_back)};
}

void FrameSlot::skip(const GiveBack& give_back) {
  const std::lock_guard lock(mutex_);
  give_back();
}

void FrameSlot::spoil(std::string why, const GiveBack& give_back) {
  const std::lock_guard lock(mutex_);
  let_go();
  give_back();
  taken_ = false;
  spoiled_ = std::move(why);
}

void FrameSlot::remove(const std::uint8_t* data) {
  const std::lock_guard lock(mutex_);
  if (held_ && held_->memory == data) held_.reset();
}

void FrameSlot::clear() {
  const std::lock_guard lock(mutex_);
  held_.reset();
  taken_ = false;
  spoiled_.reset();
}

void FrameSlot::let_go() {
  if (!held_) return;
  const GiveBack give_back = std::move(held_->give_back);
  held_.reset();
  give_back();
}

}  // namespace telehug
