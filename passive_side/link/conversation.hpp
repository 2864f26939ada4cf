// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "common/clock.hpp"
#include "link/frame_codec.hpp"
#include "link/jacket_link.hpp"

namespace telehug {

// What is said on the wire to a jacket, without any wire: bytes and time in, bytes out.
class Conversation {
 public:
  virtual ~Conversation() = default;

  // A wire stands (or has gone). Nothing has been said on it yet.
  virtual void connected(Timestamp now) = 0;
  virtual void disconnected() = 0;

  virtual void receive(std::span<const std::uint8_t> bytes, Timestamp now) = 0;

  // As JacketLink.
  virtual bool send(const MotorCommands& commands, Timestamp now) = 0;
  virtual bool heat(const HeaterCommands& commands, Timestamp now) = 0;
  virtual void stop_all() = 0;

  // What to write now; empty if there is nothing. All of it counts as sent, so write it whole. While the wire has a
  // backlog only a stop is returned.
  [[nodiscard]] virtual EncodedFrame next_frame(Timestamp now, bool has_backlog) = 0;

  // Counters, versions and problem; the owner of the wire adds `device`.
  [[nodiscard]] virtual const LinkStatus& status() const = 0;
};

}  // namespace telehug
