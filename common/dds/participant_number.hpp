// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace telehug {

// Participants of one host and domain that find each other without multicast: discovery tries that many ports.
inline constexpr std::size_t max_loopback_participants = 10;

// The number that a participant's first ports are computed from: the lowest that this program does not use.
// Left to itself Fast DDS counts up with every participant that a process ever creates, and soon leaves the range that
// discovery without multicast tries. Ports that another program holds don't matter here: Fast DDS moves on by itself.
class ParticipantNumber {
 public:
  // Throws DdsError if all are used.
  ParticipantNumber();
  ~ParticipantNumber();
  ParticipantNumber(const ParticipantNumber&) = delete;
  ParticipantNumber& operator=(const ParticipantNumber&) = delete;

  [[nodiscard]] std::int32_t value() const noexcept { return static_cast<std::int32_t>(number_); }

 private:
  std::size_t number_ = 0;
};

}  // namespace telehug
