// SPDX-License-Identifier: Apache-2.0
#include "link/jacket_session.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace telehug {
namespace {

using protocol::FrameType;
using protocol::NackReason;

constexpr Duration duration_unit = 10ms;
constexpr auto drive_max_units = protocol::drive_max_ms / 10;

// Rounded down: a motor never runs longer than it was asked to.
std::uint8_t duration_units(Duration duration) {
  return static_cast<std::uint8_t>(std::clamp<Duration::rep>(duration / duration_unit, 0, drive_max_units));
}

}  // namespace

void JacketSession::connected(Timestamp now) {
  decoder_.reset();
  line_is_fresh_ = true;
  stop_ = Stop::wanted;
  greet(now);
}

void JacketSession::disconnected() {
  phase_ = Phase::closed;
  status_.state = LinkState::absent;
  wanted_.reset();
}

void JacketSession::greet(Timestamp now) {
  phase_ = Phase::greeting;
  status_.state = LinkState::connecting;
  status_.problem = "waiting for the jacket's answer";
  refused_ = false;
  // Tells the answers of this greeting from those that an earlier one has left on the wire.
  nonce_ = static_cast<std::uint16_t>(nonce_ + 1 + (to_ns(now) & 0xFF));
  greeting_since_ = now;
  next_hello_ = now;
  wanted_.reset();
  running_ = {};
}

void JacketSession::receive(std::span<const std::uint8_t> bytes, Timestamp now) {
  for (const std::uint8_t byte : bytes) {
    if (const auto frame = decoder_.push(byte)) on_frame(*frame, now);
  }
  status_.malformed_frames = decoder_.malformed() + unexpected_frames_;
}

void JacketSession::on_frame(const Frame& frame, Timestamp now) {
  if (phase_ == Phase::closed) return;
  ++status_.frames_received;
  if (const auto caps = parse_caps(frame)) {
    last_heard_ = now;
    if (phase_ == Phase::greeting && caps->nonce == nonce_) on_caps(*caps);
  } else if (frame.type == FrameType::ack && frame.payload.size() == 1) {
    last_heard_ = now;
    if (stop_ == Stop::unacknowledged && frame.sequence == stop_sequence_) stop_ = Stop::none;
  } else if (frame.type == FrameType::nack && frame.payload.size() == 2) {
    last_heard_ = now;
    on_nack(frame, now);
  } else if (parse_telemetry(frame)) {
    last_heard_ = now;
  } else {
    ++unexpected_frames_;
  }
}

void JacketSession::on_caps(const protocol::Caps& caps) {
  status_.firmware_version = caps.firmware;
  if (caps.protocol != protocol::version || caps.motors == 0 || caps.motors > protocol::motor_count) {
    return refuse(
        fmt::format("the jacket answers with protocol {} and {} motors, which telehug does not know: update "
                    "its firmware",
                    caps.protocol, caps.motors));
  }
  status_.motor_count = caps.motors;
  status_.problem.clear();
  status_.state = LinkState::armed;
  phase_ = Phase::armed;
  if (armed_before_) ++status_.reconnects;
  armed_before_ = true;
}

void JacketSession::on_nack(const Frame& frame, Timestamp now) {
  ++status_.nacks;
  switch (static_cast<NackReason>(frame.payload[1])) {
    case NackReason::unarmed:
      if (phase_ == Phase::armed) greet(now);
      break;
    case NackReason::bad_version:
      refuse("the jacket's firmware speaks another version of the protocol: update it");
      break;
    default:
      break;
  }
}

// Goes on greeting, in case somebody plugs in another jacket, but keeps telling why there is none.
void JacketSession::refuse(std::string problem) {
  refused_ = true;
  status_.problem = std::move(problem);
}

bool JacketSession::send(const MotorCommands& commands, Timestamp now) {
  if (phase_ != Phase::armed) return false;
  Drives state{};
  bool drives_any = false;
  for (const MotorCommand& command : commands) {
    if (command.channel >= status_.motor_count || command.intensity == 0 || duration_units(command.duration) == 0) {
      continue;
    }
    state.at(command.channel) = {command.intensity, now + command.duration};
    drives_any = true;
  }
  if (drives_any && stop_ == Stop::unacknowledged) stop_ = Stop::none;  // it has left; a repetition would end this
  wanted_ = state;
  return true;
}

void JacketSession::stop_all() {
  wanted_.reset();
  if (phase_ != Phase::closed) stop_ = Stop::wanted;
}

EncodedFrame JacketSession::next_frame(Timestamp now, bool has_backlog) {
  if (phase_ == Phase::closed) return {};
  if (stop_ == Stop::wanted) return make_stop(now);
  if (phase_ == Phase::armed && now - last_heard_ > silence_max) greet(now);
  if (has_backlog) return {};
  if (phase_ == Phase::greeting) {
    if (!refused_ && now - greeting_since_ > hello_patience) {
      status_.problem = "the jacket does not answer: check that it is switched on and that its firmware is telehug's";
    }
    return now >= next_hello_ ? make_hello(now) : EncodedFrame{};
  }
  if (stop_ == Stop::unacknowledged && now - stop_sent_ >= stop_repeat) return make_stop(now);
  if (wanted_ && may_send_set(now)) {
    EncodedFrame frame = make_set(now);
    if (!frame.empty()) return frame;
  }
  if (now - last_sent_ >= keep_interval) return make_frame(FrameType::keep, {}, now);
  return {};
}

EncodedFrame JacketSession::make_frame(FrameType type, const FramePayload& payload, Timestamp now) {
  ++status_.frames_sent;
  last_sent_ = now;
  return encode({type, ++sequence_, payload});
}

EncodedFrame JacketSession::make_stop(Timestamp now) {
  EncodedFrame frame = make_frame(FrameType::stop_all, {}, now);
  if (line_is_fresh_) frame.insert(frame.begin(), 0);  // ends whatever a bootloader or an earlier host left on the line
  line_is_fresh_ = false;
  stop_ = Stop::unacknowledged;
  stop_sequence_ = sequence_;
  stop_sent_ = now;
  running_ = {};
  return frame;
}

EncodedFrame JacketSession::make_hello(Timestamp now) {
  next_hello_ = now + hello_interval;
  return make_frame(FrameType::hello,
                    {protocol::version, protocol::version, static_cast<std::uint8_t>(nonce_ & 0xFF),
                     static_cast<std::uint8_t>(nonce_ >> 8)},
                    now);
}

// A state that turns something down or off goes at once; one that only drives waits for its turn.
bool JacketSession::may_send_set(Timestamp now) const {
  if (now - last_set_ >= set_interval) return true;
  for (std::size_t channel = 0; channel < running_.size(); ++channel) {
    const bool runs = running_.at(channel).end > now;
    if (runs && wanted_->at(channel).intensity < running_.at(channel).intensity) return true;
  }
  return false;
}

EncodedFrame JacketSession::make_set(Timestamp now) {
  FramePayload payload;
  bool drives_any = false;
  for (std::size_t channel = 0; channel < running_.size(); ++channel) {
    const Drive& wanted = wanted_->at(channel);
    Drive& running = running_.at(channel);
    const std::uint8_t units = wanted.intensity == 0 ? std::uint8_t{0} : duration_units(wanted.end - now);
    if (units == 0 && running.end <= now) continue;
    const std::uint8_t intensity = units == 0 ? std::uint8_t{0} : wanted.intensity;
    for (const std::uint8_t byte : {static_cast<std::uint8_t>(channel), intensity, units})
      payload.push_back(byte);
    running = {intensity, now + units * duration_unit};
    drives_any = drives_any || units != 0;
  }
  wanted_.reset();
  if (payload.empty()) return {};
  last_set_ = now;
  return drives_any ? make_frame(FrameType::set, payload, now) : make_stop(now);
}

}  // namespace telehug
