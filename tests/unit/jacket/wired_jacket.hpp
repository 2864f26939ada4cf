// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "doubles/scripted_opener.hpp"
#include "jacket/load_jacket_profile.hpp"
#include "link/frame_codec.hpp"
#include "link/jacket_session.hpp"
#include "link/legacy_session.hpp"
#include "link/wire_link.hpp"
#include "rendering/jacket_renderer.hpp"
#include "safety/safety_stage.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {

// A shipped jacket on a wire, with everything that is before the wire: touches in, bytes out, on a clock that goes on
// by rounds of the drive thread. The microcontroller is the test's: it answers as the firmware of a healthy jacket
// does, whose pads have 33.0 C.
class WiredJacket {
 public:
  static constexpr Duration round = 10ms;

  // `file`: in deploy/jackets.
  explicit WiredJacket(const std::string& file)
      : profile(load_jacket_profile(TELEHUG_SOURCE "/deploy/jackets/" + file).value()) {
    for (const Actuator& actuator : profile.actuators)
      ++(actuator.kind == ActuatorKind::motor ? motors_ : heaters_);
    for (Duration passed{}; safety_.link_status().state != LinkState::armed; passed += round) {
      if (passed > 5s) throw std::runtime_error("the jacket does not arm: " + safety_.link_status().problem);
      go_on();
    }
    pass(100ms);
    start_ = now;
    log.clear();
  }

  // The sender's next event.
  void feel(const std::vector<Contact>& contacts) {
    drive(renderer_.plan(event_of(++sequence_, contacts), {}, now).drives);
  }
  void feel(const Contact& contact) { feel(std::vector{contact}); }
  void drive(const Drives& drives) {
    safety_.apply(0, drives, now);
    listen();
  }

  // Time goes on without an event.
  void pass(Duration time) {
    for (Duration passed{}; passed < time; passed += round)
      go_on();
  }
  // Time goes on with an event every 30 ms that tells the same.
  void rest(Contact contact, Duration time) {
    contact.phase = Phase::move;
    for (Duration passed{}; passed < time; passed += 3 * round) {
      pass(3 * round);
      feel(contact);
    }
  }

  // What the last frame that drives motors told: "channel=intensity ms", or of heaters: "heater=set-point ms".
  [[nodiscard]] const std::string& motors_told() const { return motors_told_; }
  [[nodiscard]] const std::string& heaters_told() const { return heaters_told_; }
  // The bytes of the last frame to the heaters.
  [[nodiscard]] const std::string& heat_bytes() const { return heat_bytes_; }

  const JacketProfile profile;
  Timestamp now = from_ns(1'000'000'000);
  std::string log;  // a line for each frame that drives or stops, with its delimiter: "ms: bytes"; of a legacy jacket
                    // for all that came at once

 private:
  [[nodiscard]] std::unique_ptr<Conversation> conversation() const {
    if (profile.protocol == JacketProtocol::legacy) return std::make_unique<LegacySession>();
    return std::make_unique<JacketSession>();
  }

  void go_on() {
    now += round;
    if ((now - from_ns(0)) % 100ms == 0ms) safety_.on_heartbeat(0, now);
    if (const Drives& drives = renderer_.tick(now); !drives.empty()) drive(drives);
    safety_.tick(now);
    listen();
  }

  void note(std::span<const std::uint8_t> bytes) {
    log += fmt::format("{:.0f}: {:02x}\n", to_ms(now - start_), fmt::join(bytes, " "));
  }

  void listen() {
    if (!far_.wire) return;
    const std::vector<std::uint8_t> bytes = far_.wire->read();
    if (profile.protocol == JacketProtocol::legacy) {
      if (!bytes.empty()) note(bytes);
      return;
    }
    for (const std::uint8_t byte : bytes) {
      frame_.push_back(byte);
      const auto frame = decoder_.push(byte);
      if (frame) obey(*frame);
      if (byte == 0) frame_.clear();
    }
  }

  void obey(const Frame& frame) {
    using protocol::FrameType;
    const auto n = [&frame](std::size_t at) { return static_cast<int>(frame.payload.at(at)); };
    if (frame.type == FrameType::set) {
      motors_told_.clear();
      for (std::size_t at = 0; at < frame.payload.size(); at += protocol::set_entry_bytes)
        motors_told_ += fmt::format("{}{}={} {}ms", at == 0 ? "" : ", ", n(at), n(at + 1), n(at + 2) * 10);
    } else if (frame.type == FrameType::heat) {
      heat_bytes_ = fmt::format("{:02x}", fmt::join(frame_, " "));
      heaters_told_.clear();
      for (std::size_t at = 0; at < frame.payload.size(); at += protocol::heat_entry_bytes)
        heaters_told_ += fmt::format("{}{}={:.1f} {}ms", at == 0 ? "" : ", ", n(at),
                                     (n(at + 1) | n(at + 2) << 8) / 10.0, n(at + 3) * 10);
    }
    if (frame.type == FrameType::set || frame.type == FrameType::heat || frame.type == FrameType::stop_all)
      note(frame_);
    answer(frame);
  }

  void answer(const Frame& frame) const {
    using protocol::FrameType;
    if (frame.type == FrameType::hello) {
      return say({FrameType::caps,
                  frame.sequence,
                  {protocol::version, 1, motors_, heaters_, heaters_, 32, 64, 50, 25, 1, frame.payload.at(2),
                   frame.payload.at(3)}});
    }
    if (frame.type != FrameType::status)
      return say({FrameType::ack, frame.sequence, {static_cast<std::uint8_t>(frame.type)}});
    FramePayload telemetry{0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0x88, 0x13};  // 5000 mV
    for (int heater = 0; heater < heaters_; ++heater)
      telemetry.insert(telemetry.end(), {0x4A, 0x01, 0});  // 33.0 C, no fault
    say({FrameType::telemetry, frame.sequence, telemetry});
  }
  void say(const Frame& frame) const {
    const EncodedFrame bytes = encode(frame);
    far_.wire->write({bytes.data(), bytes.size()});
  }

  FarEnd far_;
  SafetyStage safety_{std::make_unique<WireLink>(std::make_unique<ScriptedOpener>(far_), conversation()), profile, {}};
  JacketRenderer renderer_{profile, 200ms};
  FrameDecoder decoder_;
  std::vector<std::uint8_t> frame_;
  std::uint8_t motors_ = 0;
  std::uint8_t heaters_ = 0;
  std::uint64_t sequence_ = 0;
  Timestamp start_;
  std::string motors_told_;
  std::string heaters_told_;
  std::string heat_bytes_;
};

}  // namespace telehug
