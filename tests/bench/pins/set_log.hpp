// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <mutex>
#include <span>
#include <vector>

#include "common/clock.hpp"
#include "link/frame_codec.hpp"

namespace telehug {

// The last byte of a SET frame was on the wire at `time`; intensity above 0 for the channels it asks for.
struct WrittenSet {
  Timestamp time;
  std::array<std::uint8_t, protocol::motor_count> intensity{};
};

// Reads along what the daemon says to the jacket. For two threads: one notes, one takes.
class SetLog {
 public:
  void note(std::span<const std::uint8_t> bytes, Timestamp time);
  // Those since the last call.
  [[nodiscard]] std::vector<WrittenSet> take();

 private:
  FrameDecoder decoder_;
  std::mutex mutex_;
  std::vector<WrittenSet> written_;  // guarded by mutex_
};

}  // namespace telehug
