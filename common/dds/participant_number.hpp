// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace telehug {

// Participants of one host and domain that find each other without multicast: discovery tries that many ports.
inline constexpr std::size_t max_loopback_participants = 10;
// Of a domain: the ports of higher numbers are the next domain's (RTPS 2.2, 9.6.1.1).
inline constexpr std::size_t max_participants = 120;

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

  // Never to be given out again: Fast DDS 2.9 keeps the number of a participant that it failed to create (as with a
  // pair's files that it refuses), and would refuse every later one of that number, good as it may be.
  void use_up() noexcept { used_up_ = true; }

  [[nodiscard]] std::int32_t value() const noexcept { return static_cast<std::int32_t>(number_); }

 private:
  std::size_t number_ = 0;
  bool used_up_ = false;
};

}  // namespace telehug
