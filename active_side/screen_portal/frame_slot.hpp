// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "screen_portal/frame_in_memory.hpp"

namespace telehug {

// Hands the newest frame from the thread that gets them to the thread that looks at them. The frame stays in the memory
// in which it came until somebody wants to see it: of 60 frames a second that nobody looks at none is copied.
class FrameSlot {
 public:
  using GiveBack = std::function<void()>;

  // `frame` can be read until `give_back` was called or remove() or clear() has returned. `give_back` is called from
  // either thread, but never from both at once; it must not call the slot.
  void put(const FrameInMemory& frame, GiveBack give_back);

  // What came is nothing to look at; the frame before it stays.
  void skip(const GiveBack& give_back);

  // What came is no picture; `why` is the rest of a sentence. It is what take() says until a frame is put.
  void spoil(std::string why, const GiveBack& give_back);

  // The memory at `data` goes away: a frame in it is forgotten, not given back.
  void remove(const std::uint8_t* data);

  // What was put is no longer what is to be seen. Forgets everything and gives nothing back.
  void clear();

  enum class Taken {
    frame,      // a frame that was not taken before
    unchanged,  // what was taken last is still the newest
    nothing,    // there is no frame
    spoiled,    // `why` says why
  };

  // `look(picture, order)` is called for a frame, which lies still meanwhile and goes away with its return.
  template <typename Look>
  Taken take(std::string& why, Look&& look) {
    const std::lock_guard lock(mutex_);
    if (spoiled_) {
      why = *spoiled_;
      return Taken::spoiled;
    }
    if (!held_) return taken_ ? Taken::unchanged : Taken::nothing;
    look(held_->pixels, held_->order);
    let_go();
    taken_ = true;
    return Taken::frame;
  }

 private:
  struct Held {
    cv::Mat pixels;
    PixelOrder order = PixelOrder::bgrx;
    const std::uint8_t* memory = nullptr;
    GiveBack give_back;
  };

  void let_go();  // with the mutex locked

  std::mutex mutex_;
  std::optional<Held> held_;
  bool taken_ = false;  // was the newest frame taken?
  std::optional<std::string> spoiled_;
};

}  // namespace telehug
