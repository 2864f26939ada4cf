// SPDX-License-Identifier: Apache-2.0
#include "link/legacy_session.hpp"

namespace telehug {

LegacySession::LegacySession() {
  status_.answers = false;
}

void LegacySession::connected(Timestamp now) {
  ready_at_ = now + boot_time;
  status_.state = LinkState::connecting;
  status_.problem = "waiting until the jacket has started";
}

void LegacySession::disconnected() {
  ready_at_.reset();
  stop_all();
  status_.state = LinkState::absent;
  status_.motor_count = 0;
}

// It has nothing to say: these are a bootloader's or a sketch's own words.
void LegacySession::receive(std::span<const std::uint8_t> /*bytes*/, Timestamp /*now*/) {}

bool LegacySession::send(const MotorCommands& commands, Timestamp now) {
  if (status_.state != LinkState::armed) return false;
  for (Motor& motor : motors_)
    motor.wanted_until = now;
  for (const MotorCommand& command : commands) {
    if (command.channel < motors_.size() && command.intensity > 0) {
      motors_.at(command.channel).wanted_until = now + command.duration;
    }
  }
  return true;
}

void LegacySession::stop_all() {
  for (Motor& motor : motors_)
    motor.wanted_until = {};
}

EncodedFrame LegacySession::next_frame(Timestamp now, bool has_backlog) {
  if (!ready_at_ || now < *ready_at_) return {};
  if (status_.state != LinkState::armed) {
    status_.state = LinkState::armed;
    status_.problem.clear();
    status_.motor_count = protocol::motor_count;
    if (armed_before_) ++status_.reconnects;
    armed_before_ = true;
  }
  if (has_backlog) return {};
  EncodedFrame bytes;
  for (std::size_t channel = 0; channel < motors_.size(); ++channel) {
    Motor& motor = motors_.at(channel);
    const bool runs = motor.pulsed && now < *motor.pulsed + pulse;
    const bool is_due = runs ? now >= *motor.pulsed + pulse_interval && motor.wanted_until > *motor.pulsed + pulse
                             : motor.wanted_until > now;
    if (!is_due) continue;
    motor.pulsed = now;
    bytes.push_back(static_cast<std::uint8_t>(channel + 1));
  }
  if (!bytes.empty()) ++status_.frames_sent;
  return bytes;
}

}  // namespace telehug
