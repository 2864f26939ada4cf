// SPDX-License-Identifier: Apache-2.0
//
// The host's side of the conversation with the microcontroller, without any wire: bytes and time in, frames out.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "common/clock.hpp"
#include "link/frame_codec.hpp"
#include "link/jacket_link.hpp"

namespace telehug {

// Says hello until the jacket answers, keeps it alive, carries the newest state and nothing older, and starts over when
// the jacket falls silent or has disarmed itself.
class JacketSession {
 public:
  static constexpr Duration hello_interval = 200ms;
  static constexpr Duration hello_patience = 3s;  // then status().problem says that nobody answers; it goes on trying
  static constexpr Duration keep_interval = 100ms;
  static constexpr Duration silence_max = 1s;
  static constexpr Duration set_interval = 20ms;  // for states that only drive more or longer
  static constexpr Duration stop_repeat = 50ms;   // until the jacket acknowledges

  // A wire stands (or has gone). Nothing has been said on it yet; the first frame turns everything off.
  void connected(Timestamp now);
  void disconnected();

  void receive(std::span<const std::uint8_t> bytes, Timestamp now);

  // As JacketLink.
  bool send(const MotorCommands& commands, Timestamp now);
  void stop_all();

  // The frame to write now; empty if there is none. Each one returned counts as sent, so write it whole. While the wire
  // has a backlog only a stop is returned.
  [[nodiscard]] EncodedFrame next_frame(Timestamp now, bool has_backlog);

  [[nodiscard]] bool armed() const { return phase_ == Phase::armed; }
  // Counters, versions and problem; the owner of the wire adds `device`.
  [[nodiscard]] const LinkStatus& status() const { return status_; }

 private:
  enum class Phase { closed, greeting, armed };
  enum class Stop { none, wanted, unacknowledged };
  struct Drive {
    std::uint8_t intensity = 0;
    Timestamp end;
  };
  using Drives = std::array<Drive, protocol::motor_count>;

  void greet(Timestamp now);
  void on_frame(const Frame& frame, Timestamp now);
  void on_caps(const protocol::Caps& caps);
  void on_nack(const Frame& frame, Timestamp now);
  [[nodiscard]] EncodedFrame make_frame(protocol::FrameType type, const FramePayload& payload, Timestamp now);
  [[nodiscard]] EncodedFrame make_stop(Timestamp now);
  [[nodiscard]] EncodedFrame make_hello(Timestamp now);
  [[nodiscard]] EncodedFrame make_set(Timestamp now);
  [[nodiscard]] bool may_send_set(Timestamp now) const;
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
  Timestamp last_sent_;

  Stop stop_ = Stop::none;
  bool line_is_fresh_ = false;
  std::uint8_t stop_sequence_ = 0;
  Timestamp stop_sent_;

  std::optional<Drives> wanted_;  // newest state that has not left yet
  Drives running_{};              // what the jacket was told, and until when
  Timestamp last_set_;
};

}  // namespace telehug
