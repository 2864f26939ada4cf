// SPDX-License-Identifier: Apache-2.0
//
// The host's side of the protocol that protocol.hpp describes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "common/clock.hpp"
#include "link/conversation.hpp"
#include "link/drive_pace.hpp"
#include "link/frame_codec.hpp"
#include "link/jacket_link.hpp"

namespace telehug {

// Says hello until the jacket answers, keeps it alive, carries the newest state and nothing older, and starts over when
// the jacket falls silent or has disarmed itself.
class JacketSession final : public Conversation {
 public:
  static constexpr Duration hello_interval = 200ms;
  static constexpr Duration hello_patience = 3s;  // then status().problem says that nobody answers; it goes on trying
  static constexpr Duration keep_interval = 100ms;
  static constexpr Duration silence_max = 1s;
  static constexpr Duration status_interval = 500ms;
  static constexpr Duration stop_repeat = 50ms;  // until the jacket acknowledges
  // So long may frames wait for any answer; then states wait, too. A jacket that is not heard may not hear, and
  // Bluetooth takes more than the jacket has read and would hand it over late. With drives of 200 ms (`drive_ms` as
  // shipped) and 20 ms between two frames all is off in less than 300 ms after the jacket's last answer.
  static constexpr Duration answer_patience = 70ms;

  // The first frame turns everything off.
  void connected(Timestamp now) override;
  void disconnected() override;

  void receive(std::span<const std::uint8_t> bytes, Timestamp now) override;

  bool send(const MotorCommands& commands, Timestamp now) override;
  bool heat(const HeaterCommands& commands, Timestamp now) override;
  void stop_all() override;

  [[nodiscard]] EncodedFrame next_frame(Timestamp now, bool has_backlog) override;

  [[nodiscard]] bool armed() const { return phase_ == Phase::armed; }
  [[nodiscard]] const LinkStatus& status() const override { return status_; }

 private:
  enum class Phase { closed, greeting, armed };
  enum class Stop { none, wanted, unacknowledged };
  struct Drive {
    std::uint8_t intensity = 0;
    Timestamp end;
  };
  using Drives = std::array<Drive, protocol::motor_count>;
  struct Heat {
    std::uint16_t decidegrees = 0;  // 0: off
    Timestamp end;
  };

  void greet(Timestamp now);
  void on_frame(const Frame& frame, Timestamp now);
  void note_answer(Timestamp now);
  void on_caps(const protocol::Caps& caps, Timestamp now);
  void on_nack(const Frame& frame, Timestamp now);
  [[nodiscard]] EncodedFrame make_frame(protocol::FrameType type, const FramePayload& payload, Timestamp now);
  [[nodiscard]] EncodedFrame make_stop(Timestamp now);
  [[nodiscard]] EncodedFrame make_hello(Timestamp now);
  [[nodiscard]] EncodedFrame make_drive(Timestamp now);
  [[nodiscard]] EncodedFrame make_set(Timestamp now);
  [[nodiscard]] EncodedFrame make_heat(Timestamp now);
  [[nodiscard]] bool wants_less_drive(Timestamp now) const;
  [[nodiscard]] bool wants_less_heat(Timestamp now) const;
  [[nodiscard]] bool wants_no_drive() const;
  [[nodiscard]] bool wants_heat() const;
  [[nodiscard]] bool heats(Timestamp now) const;
  void forget_wanted();
  void refuse(std::string problem);

  Phase phase_ = Phase::closed;
  LinkStatus status_;
  FrameDecoder decoder_;
  std::uint64_t unexpected_frames_ = 0;
  bool armed_before_ = false;
  bool refused_ = false;

  std::uint8_t sequence_ = 0;
  std::uint16_t nonce_ = 0;
  Timestamp greeting_since_;
  Timestamp next_hello_;
  Timestamp last_heard_;
  std::optional<Timestamp> unanswered_since_;  // the first frame since then
  Timestamp last_sent_;

  Stop stop_ = Stop::none;
  bool line_is_fresh_ = false;
  std::uint8_t stop_sequence_ = 0;
  Timestamp stop_sent_;

  // What the jacket was told and until when, and the newest that has not left yet.
  Drives running_{};
  std::optional<Drives> wanted_;
  std::array<Heat, protocol::heater_count> heating_{};
  std::array<std::optional<Heat>, protocol::heater_count> wanted_heat_{};
  DrivePace pace_;
  bool heat_is_next_ = false;  // where motors and heaters wait for the same turn

  std::size_t temperatures_ = 0;  // that the jacket announced
  Timestamp next_status_;
};

}  // namespace telehug
