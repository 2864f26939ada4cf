// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "link/conversation.hpp"

namespace telehug {

// The thesis' jacket, which knows one thing: a byte with the number of a motor, its channel + 1, starts a pulse of
// 250 ms. It answers nothing and takes no stop. So nobody can tell whether it is there, and what was started ends by
// itself: as long as a drive outlasts the pulse that runs, another one follows, and none for its last 250 ms.
class LegacySession final : public Conversation {
 public:
  static constexpr Duration boot_time = 2s;  // opening the port resets the jacket; its bootloader would take the bytes
  static constexpr Duration pulse = 250ms;
  static constexpr Duration pulse_interval = 200ms;  // of one motor, at least

  LegacySession();

  void connected(Timestamp now) override;
  void disconnected() override;

  void receive(std::span<const std::uint8_t> bytes, Timestamp now) override;

  bool send(const MotorCommands& commands, Timestamp now) override;
  bool heat(const HeaterCommands&, Timestamp) override { return false; }
  void stop_all() override;

  [[nodiscard]] EncodedFrame next_frame(Timestamp now, bool has_backlog) override;
  [[nodiscard]] const LinkStatus& status() const override { return status_; }

 private:
  struct Motor {
    Timestamp wanted_until;
    std::optional<Timestamp> pulsed;  // when its last pulse began
  };

  std::optional<Timestamp> ready_at_;  // empty: no wire
  std::array<Motor, protocol::motor_count> motors_{};
  bool armed_before_ = false;
  LinkStatus status_;
};

}  // namespace telehug
