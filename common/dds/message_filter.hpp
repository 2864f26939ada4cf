// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <vector>

#include "dds/plain_payload.hpp"

namespace telehug {

// May this RTPS message reach a paired side's Fast DDS? One that is encrypted as a whole, and what can't be: who is
// there (SPDP), the handshake, and the exchange of keys, which is encrypted part by part. Fast DDS 2.9 would take
// everything else as well, in anybody's name, although rtps_protection_kind is ENCRYPT: touches, heartbeats, even keys.
// Nor may a stranger end a participant's presence in its name (CVE-2023-50257), or make Fast DDS reserve gigabytes. A
// message that Fast DDS might read otherwise than this does is refused.
[[nodiscard]] bool may_pass(std::span<const std::uint8_t> message) noexcept;

// Nothing that a participant of telehug announces of itself ever changes: who says something else in its name is not
// it. Any thread.
class Announcements {
 public:
  // So many participants are remembered; of a flood of others it forgets the oldest.
  static constexpr std::size_t most_remembered = 256;

  // Of a message that may pass: is what it announces, if anything, the same as before?
  [[nodiscard]] bool are_as_before(std::span<const std::uint8_t> message);

 private:
  struct Known {
    GuidPrefix of;
    std::vector<std::uint8_t> payload;
  };

  std::mutex mutex_;
  std::deque<Known> known_;  // oldest first
};

}  // namespace telehug
