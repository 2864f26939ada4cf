// SPDX-License-Identifier: Apache-2.0
#include "bench/pins/set_log.hpp"

#include <utility>

namespace telehug {

void SetLog::note(std::span<const std::uint8_t> bytes, Timestamp time) {
  for (const std::uint8_t byte : bytes) {
    const auto frame = decoder_.push(byte);
    if (!frame || frame->type != protocol::FrameType::set) continue;
    WrittenSet set{time, {}};
    for (std::size_t at = 0; at + protocol::set_entry_bytes <= frame->payload.size(); at += protocol::set_entry_bytes)
      if (frame->payload[at] < protocol::motor_count) set.intensity.at(frame->payload[at]) = frame->payload[at + 1];
    const std::lock_guard lock(mutex_);
    written_.push_back(set);
  }
}

std::vector<WrittenSet> SetLog::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(written_, {});
}

}  // namespace telehug
